"""How many files the supervisor may have open: a handful for each process, and the usual limit is 1024.

The soft limit is low for the sake of programs that use select(2); the hard one is what the system means (getrlimit(2)).
So the supervisor takes more for itself when it comes to need it, and programs get what it was given.
"""

from __future__ import annotations

import contextlib
import os
import resource
from functools import cache
from typing import TYPE_CHECKING, Final

from orchestra.logs.rotation import OPENING

if TYPE_CHECKING:
    from collections.abc import Iterator

# For some thousand processes; the hard limit can be a thousand million.
_ENOUGH: Final = 65536
# More is taken when so much of what was given is in use: the rest is for what needs no start of a process.
_SHARE: Final = 4
_STANDARD: Final = 3


class BusyError(OSError):
    """The limit cannot be lowered now: the thread that writes is opening a file."""


@cache
def _given() -> tuple[int, int]:
    """Return soft and hard limit as they were when this was asked first."""
    return resource.getrlimit(resource.RLIMIT_NOFILE)


def keep_to_ourselves() -> None:
    """Let no program inherit what whoever started us has left open."""
    for name in os.listdir("/proc/self/fd"):  # noqa: PTH208 - numbers
        with contextlib.suppress(OSError):  # the one with which this was listed
            if int(name) >= _STANDARD:
                os.set_inheritable(int(name), False)


def see_to_room(highest: int) -> None:
    """Take more where the highest descriptor in use says that it will be needed, as far as that is allowed."""
    soft, hard = _given()
    if soft != resource.RLIM_INFINITY and highest * _SHARE >= soft:
        _taken(soft, hard)


@contextlib.contextmanager
def as_given() -> Iterator[None]:
    """Have, for a moment, the limits that were there before, so that a program begins with them.

    Raises `BusyError` where somebody else could come to want the higher ones meanwhile.
    """
    if not _taken.cache_info().currsize:
        yield
        return
    if not OPENING.acquire(blocking=False):
        raise BusyError
    try:
        give_back()
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, _taken(*_given()))
        OPENING.release()


def give_back() -> None:
    """Have the limits again that were there before: a program begins with them."""
    resource.setrlimit(resource.RLIMIT_NOFILE, _given())


@cache
def _taken(soft: int, hard: int) -> tuple[int, int]:
    """Take more, once; return what we have then."""
    most = _ENOUGH if hard == resource.RLIM_INFINITY else min(hard, _ENOUGH)
    if soft < most:
        with contextlib.suppress(OSError, ValueError):  # it goes on with what it has
            resource.setrlimit(resource.RLIMIT_NOFILE, (most, hard))
            return most, hard
    return soft, hard
