"""SIGTERM and SIGHUP end a command that starts nothing as Ctrl-C does: with all removed that it has made.

Rejected: to remove it in the handler. What there is to remove, and to end, is known where it was made.
"""

from __future__ import annotations

import _signal as signal  # type: ignore[import-not-found] # `signal` makes enumerations, which takes longer than this
import os
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, Final

from orchestra.cli.boundary import EndedError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

_ENDING: Final = (signal.SIGTERM, signal.SIGHUP)
_PATIENCE: Final = 10.0  # seconds after which a command ends though code of a launch file does not let go


@contextmanager
def heeded() -> Iterator[None]:
    """Raise `EndedError` where one of them arrives meanwhile.

    More of them change nothing, while the interpreter ends neither: timeout(1), service managers and containers send
    several. One that is ignored stays so: that is how nohup(1) says that a command is to go on.
    """
    own, told, before = os.getpid(), False, tuple(filter(_is_usual, _ENDING))

    def end(number: int, frame: FrameType | None) -> None:
        del frame
        nonlocal told
        if os.getpid() != own:  # code of a launch file has forked, and this is the other process
            signal.signal(number, signal.SIG_DFL)
            os.kill(os.getpid(), number)
        if told:
            return
        told = True
        error = EndedError(number)
        _insist(error.status)
        raise error

    def leave(number: int) -> None:
        signal.signal(number, signal.SIG_IGN if told else signal.SIG_DFL)

    with ExitStack() as heeding:
        for number in before:
            heeding.callback(leave, number)
            signal.signal(number, end)
        yield


def _is_usual(number: int) -> bool:
    return bool(signal.getsignal(number) == signal.SIG_DFL)


def _insist(status: int) -> None:
    """End this process by and by, whatever its code does about what is raised in it, and threads that it leaves."""
    from threading import Timer  # noqa: PLC0415 - hardly ever needed

    last = Timer(_PATIENCE, os._exit, (status,))
    last.daemon = True
    last.start()
