"""Takes requests and forks: once in between, so that the nodes become children of the supervisor, a subreaper.

Who has lost its parent is given to the next subreaper above (prctl(2), PR_SET_CHILD_SUBREAPER). The process in between
forks for several requests at once; a node is announced when it has ended: then it is the supervisor's child already.
"""

from __future__ import annotations

import _socket  # `socket` imports three more modules
import array
import gc
import json
import os
import signal
import sys
import threading
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NoReturn

from orchestra.ros.warm import shown
from orchestra.ros.warm.born import born
from orchestra.ros.warm.forking import FAILED, fork
from orchestra.ros.warm.preloading import preload, preload_common
from orchestra.ros.warm.request import Request
from orchestra.ros.warm.shadows import loaded_since
from orchestra.ros.warm.tracing import Tracing
from orchestra.stack import roomy
from orchestra.supervise.keeping import kernel

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Sequence
    from types import ModuleType

    from orchestra.ros.warm.born import Born

NAME = "orc-warm"
_LARGEST = 1 << 18  # bytes of a message
_DESCRIPTORS = 4
# So many are forked before the first of them begins: a fork in between costs as much as one of a node.
_AT_ONCE = 8


@roomy  # what it imports has it, too; a node does not run below it
def serve(path: Sequence[str], modules: Collection[str]) -> Born:
    """Serve until nobody asks any more; returns in the processes of nodes alone.

    The one argument of the program is our parent's pid; `path` and `modules` are those of a fresh interpreter.
    """
    kernel.set_name(NAME)
    kernel.die_with_parent(signal.SIGKILL, int(sys.argv[1]))
    connection = _socket.socket(fileno=os.dup(0))
    os.dup2(os.open(os.devnull, os.O_RDONLY | os.O_CLOEXEC), 0)
    try:
        with _quietly_interrupted():
            _make_ready(connection)
            tracing = Tracing()
            loaded, request = loaded_since(modules), None
            while request is None:
                starts, targets = _received(connection)
                if targets:
                    with _frozen(connection):
                        preload(targets)
                    loaded = loaded_since(modules)
                request = _fork_all(connection, starts, tracing)
    except ConnectionError:
        _leave()
    return born(request, path, loaded, tracing)


class _quietly_interrupted:  # noqa: N801 - a context manager that reads like a word
    """Whoever signals the server wants it gone, without a traceback; a node has the interpreter's own handler again."""

    def __enter__(self) -> None:
        self._before = signal.signal(signal.SIGINT, signal.SIG_DFL)

    def __exit__(self, *_: object) -> None:
        signal.signal(signal.SIGINT, self._before)


def _make_ready(connection: _socket.socket) -> None:
    with _frozen(connection):
        try:
            preload_common()
        except Exception as error:  # noqa: BLE001 - told to the supervisor, which starts the nodes without us
            _refuse(connection, f"{type(error).__name__}: {error}")
    shown.prepare()


@contextmanager
def _frozen(connection: _socket.socket) -> Iterator[None]:
    """Leave what is imported to all processes alike: the collector, which writes to what it looks at, never will."""
    gc.disable()
    yield
    running = [thread.name for thread in threading.enumerate() if thread is not threading.main_thread()]
    if running:  # a fork copies no thread, and their locks stay as they are
        _refuse(connection, f"an import has started threads: {', '.join(running)}")
    _keep_for_ever(sys.modules["__main__"])
    gc.freeze()
    gc.enable()


def _keep_for_ever(module: ModuleType) -> None:
    """Let the collector, which is about to freeze what there is, never find that nobody needs a module any more.

    Where a program ends by an error, the interpreter gives its `__main__` back before it takes `__file__` out of the
    dictionary in it (CPython 3.11 to 3.13, `_PyRun_SimpleFileObject`). With ours replaced by that of a node, this one
    would be gone by then, and the node would end by SIGSEGV.
    """
    kept: list[object] = [module]
    kept.append(kept)


def _refuse(connection: _socket.socket, reason: str) -> NoReturn:
    connection.send(json.dumps({"unusable": reason}).encode())
    _leave()


def _leave() -> NoReturn:
    sys.stderr.flush()
    os._exit(0)


def _fork_all(connection: _socket.socket, starts: list[Request], tracing: Tracing) -> Request | None:
    """Fork for all; return one of them in the process that is to become its node."""
    for index in range(0, len(starts), _AT_ONCE):
        mine = _fork_some(connection, starts[index : index + _AT_ONCE], tracing)
        if mine:
            return mine
    return None


def _received(connection: _socket.socket) -> tuple[list[Request], list[tuple[str, str]]]:
    """Return all requests that wait, after the first of them, and what is to be imported for later ones."""
    starts: list[Request] = []
    targets: list[tuple[str, str]] = []
    flags = 0
    while True:
        try:
            facts, descriptors = _message(connection, flags)
        except BlockingIOError:
            return starts, targets
        if "prepare" in facts:
            targets.extend((kind, name) for kind, name in facts["prepare"])
        else:
            starts.append(Request(facts, descriptors))
        flags = _socket.MSG_DONTWAIT


def _message(connection: _socket.socket, flags: int) -> tuple[dict[str, Any], list[int]]:
    """Return one message. Raises `ConnectionError` where there is nobody any more, `BlockingIOError` with that flag."""
    space = _socket.CMSG_SPACE(_DESCRIPTORS * array.array("i").itemsize)
    content, ancillary, _, _ = connection.recvmsg(_LARGEST, space, flags | _socket.MSG_CMSG_CLOEXEC)
    if not content:
        raise ConnectionResetError
    descriptors = array.array("i")
    for level, kind, data in ancillary:
        if (level, kind) == (_socket.SOL_SOCKET, _socket.SCM_RIGHTS):
            descriptors.frombytes(data[: len(data) - len(data) % descriptors.itemsize])
    return json.loads(content), list(descriptors)


def _fork_some(connection: _socket.socket, requests: list[Request], tracing: Tracing) -> Request | None:
    """Fork for some requests; return one of them in the process that is to become its node."""
    readable, writable = os.pipe()
    tracing.before_fork()
    between = fork()
    if between == 0:
        for request in requests:
            pid = fork()
            if pid == 0:
                return request
            os.write(writable, f"{pid}\n".encode())
        os._exit(0)
    tracing.in_parent()
    os.close(writable)
    if between > 0:
        os.waitpid(between, 0)
    with os.fdopen(readable, "rb") as told:
        pids = [int(line) for line in told]
    pids += [FAILED] * (len(requests) - len(pids))
    for request, pid in zip(requests, pids, strict=True):
        answer = {"cold": "there is no room for one more process"} if pid == FAILED else {"pid": pid}
        connection.send(json.dumps({"id": request.facts["id"], **answer}).encode())
        for descriptor in request.descriptors:
            os.close(descriptor)
    return None
