"""From a copy of the server to the process of one node: what a program that is started cold finds around it."""

from __future__ import annotations

import builtins
import errno
import fcntl
import json
import os
import runpy
import sys
import threading
import time
from importlib.machinery import SourceFileLoader
from types import CodeType, ModuleType
from typing import TYPE_CHECKING, Any, NoReturn

from orchestra.ros.warm import shown, streams
from orchestra.ros.warm.shadows import shadowed
from orchestra.supervise.keeping import kernel

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence
    from types import TracebackType

    from orchestra.ros.warm.request import Request
    from orchestra.ros.warm.tracing import Tracing

_GO = 3  # the descriptor on which the supervisor says that the program may begin
_ABOVE = 64  # descriptors are moved out of the way of the first ones


class ColdError(Exception):
    """It has to be started cold; the message says why."""


class Born:
    """The program of a node, ready to run: its `module`, or the script that `compiled` reads, in `namespace`."""

    def __init__(self, module: str | None, path: str, source: bytes) -> None:
        self.module = module
        self._path = path
        self._source = source
        self._main = ModuleType("__main__")
        self.namespace = self._main.__dict__
        # What pymain_run_file and its like put there (CPython, Modules/main.c).
        self.namespace.update(
            {"__annotations__": {}, "__builtins__": builtins, "__loader__": None, "__spec__": None}
        )
        if module is None:
            loader = SourceFileLoader("__main__", path)
            self.namespace.update({"__loader__": loader, "__file__": path, "__cached__": None})
        sys.modules["__main__"] = self._main

    def compiled(self) -> CodeType:
        """Return the code of the script. Raises what the compiler raises."""
        return compile(self._source, self._path, "exec", dont_inherit=True)

    def run_module(self, module: str) -> None:
        """Do what `python -m` does."""
        runpy._run_module_as_main(module)  # type: ignore[attr-defined] # noqa: SLF001 - what the interpreter calls for it

    def hide(self, server: str) -> None:
        """Let the interpreter show the error that passes as if nothing of us were below the program."""
        hook, ours = sys.excepthook, {server, __file__}

        def showing(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
            while trace is not None and trace.tb_frame.f_code.co_filename in ours:
                trace = trace.tb_next
            sys.last_traceback = trace
            sys.excepthook = hook
            hook(kind, error.with_traceback(trace), trace)

        sys.excepthook = showing


def born(request: Request, path: Sequence[str], loaded: Collection[str], tracing: Tracing) -> Born:
    """Wait until the program may begin, and put everything in its place; ends the process where that cannot be done.

    `path` is that of the interpreter when it had started, `loaded` are the modules that the server has imported since.
    """
    _take(request.descriptors)
    if not os.read(_GO, 1):
        os._exit(0)  # nobody waits for it any more
    try:
        made = _become(request.facts, path, loaded)
    except OSError as error:
        _tell([error.errno, error.strerror or str(error), error.filename])
    except ColdError as error:
        _tell({"cold": str(error)})
    except Exception as error:  # noqa: BLE001 - nothing of this may come up in a node
        _tell({"cold": f"{type(error).__name__}: {error}"})
    tracing.in_child()  # only now: its threads read the environment and open sockets
    os.close(_GO)
    return made


def _tell(message: Any) -> NoReturn:  # noqa: ANN401 - JSON
    os.write(_GO, json.dumps(message, default=str).encode())
    os._exit(1)


def _take(descriptors: list[int]) -> None:
    """Have what was passed as standard streams, and nothing else open."""
    go, output, errors, *more = (
        fcntl.fcntl(descriptor, fcntl.F_DUPFD_CLOEXEC, _ABOVE) for descriptor in descriptors
    )
    source = more[0] if more else os.open(os.devnull, os.O_RDWR | os.O_CLOEXEC)
    for descriptor, number in ((source, 0), (output, 1), (errors, 2)):
        os.dup2(descriptor, number)
    os.dup2(go, _GO, inheritable=False)
    os.closerange(_GO + 1, os.sysconf("SC_OPEN_MAX"))


def _become(facts: dict[str, Any], path: Sequence[str], loaded: Collection[str]) -> Born:
    """Do what is done between fork and exec of a cold start, then what the interpreter does until it runs a program."""
    if facts["cwd"] is not None:
        os.chdir(facts["cwd"])
    os.setsid()
    if facts["mark"] is not None:
        kernel.set_lock_limit(facts["mark"])
    _restrict(facts)
    _set_environment(facts["set"], facts["unset"])
    module = facts["target"] if facts["kind"] == "module" else None
    script = "" if module else os.path.abspath(facts["target"])  # noqa: PTH100 - as the interpreter does it
    source = b"" if module else _source_of(script, executed=facts["executed"])
    first = os.getcwd() if module else os.path.dirname(os.path.realpath(script))  # noqa: PTH109, PTH120 - as above
    sys.path[:] = path if sys.flags.safe_path else [first, *path]
    hidden = shadowed(first, loaded) if not sys.flags.safe_path else None
    if hidden:
        raise ColdError(f"{first} has a module '{hidden}' of its own")
    words = facts["words"]
    sys.orig_argv, sys.argv = list(words), list(words[1:])
    if module:
        del sys.argv[1]
    sys.executable = facts["executable"]
    streams.renew()
    _renew_state()
    for name in [name for name in sys.modules if name == "orchestra" or name.startswith("orchestra.")]:
        del sys.modules[name]
    made = Born(module, script, source)
    kernel.set_name(facts["comm"])
    shown.show(words, dict(os.environ))
    return made


def _restrict(facts: dict[str, Any]) -> None:
    """Put limits in force."""
    if facts["limits"] is None:
        return
    from orchestra.plan.codec import decode  # noqa: PLC0415 - few processes have limits
    from orchestra.supervise.limits.applied import restriction  # noqa: PLC0415
    from orchestra.values import Limits  # noqa: PLC0415

    restriction(decode(Limits, facts["limits"]), None, facts["place"])()


def _source_of(path: str, *, executed: bool) -> bytes:
    """Return the content of a script. A program that is `executed` has to be permitted to be (execve(2))."""
    if executed and not os.access(path, os.X_OK):
        number = errno.EACCES if os.path.exists(path) else errno.ENOENT  # noqa: PTH110 - as above
        raise OSError(number, os.strerror(number), path)
    try:
        with open(path, "rb") as file:  # noqa: PTH123 - as above
            return file.read()
    except OSError as error:
        raise ColdError(f"{path} cannot be read: {error.strerror}") from error


def _set_environment(given: dict[str, str], removed: list[str]) -> None:
    """Change the environment of the interpreter, and with it that of the C library."""
    for name in removed:
        os.environ.pop(name, None)
    os.environ.update(given)
    if "TZ" in given or "TZ" in removed:
        time.tzset()  # the module has read it


def _renew_state() -> None:
    """Renew what each interpreter has for itself; the module `random` does it by itself when a process forks."""
    threading.main_thread()._set_native_id()  # type: ignore[attr-defined] # noqa: SLF001 - a fork leaves the old one
    numpy_random = sys.modules.get("numpy.random")
    if numpy_random is not None:
        numpy_random.seed()
