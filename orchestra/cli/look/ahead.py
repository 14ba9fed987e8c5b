"""What another process finds out while this one imports what it is sure to need."""

from __future__ import annotations

import os
import signal
import sys
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

from orchestra.cli.look.worker import received, send
from orchestra.resolve.command_reaper import end_with_parent

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import NoReturn


@contextmanager
def ahead(find: Callable[[], Any]) -> Iterator[Callable[[], Any]]:
    """Let another process find out something, as JSON data, for a while; yield what waits for that and returns it.

    It returns None where nothing comes of it: whoever then finds it out himself meets with the reason.
    """
    sys.stdout.flush()
    sys.stderr.flush()
    reading, writing = os.pipe()
    parent, pid = os.getpid(), os.fork()
    if pid == 0:
        _find(find, writing, parent)
    os.close(writing)
    with open(reading, "rb") as stream:  # noqa: PTH123 - it is no path
        try:
            yield lambda: received(bytearray(stream.read()))
        finally:
            os.kill(pid, signal.SIGKILL)
            os.waitpid(pid, 0)


def _find(find: Callable[[], Any], writing: int, parent: int) -> NoReturn:
    try:
        with suppress(BaseException):  # whoever waits learns that by nothing being sent
            signal.signal(signal.SIGINT, signal.SIG_DFL)
            end_with_parent()
            if os.getppid() == parent:
                send(writing, find())
    finally:
        os._exit(0)
