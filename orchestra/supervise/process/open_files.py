"""How many files the supervisor may have open: a handful for each process, and the usual limit is 1024.

The soft limit is low for the sake of programs that use select(2); the hard one is what the system means (getrlimit(2)).
So the supervisor takes more for itself, and programs get what it was given.
"""

from __future__ import annotations

import contextlib
import resource
from functools import cache

# For some thousand processes; the hard limit can be a thousand million.
_ENOUGH = 65536


@cache
def _given() -> tuple[int, int]:
    """Return soft and hard limit as they were when this was asked first."""
    return resource.getrlimit(resource.RLIMIT_NOFILE)


def take_more() -> None:
    """Let this process have more files open, as far as it is allowed to."""
    soft, hard = _given()
    most = _ENOUGH if hard == resource.RLIM_INFINITY else min(hard, _ENOUGH)
    if soft != resource.RLIM_INFINITY and soft < most:
        with contextlib.suppress(OSError, ValueError):  # it goes on with what it has
            resource.setrlimit(resource.RLIMIT_NOFILE, (most, hard))


def give_back() -> None:
    """Have the limits again that were there before: a program begins with them."""
    resource.setrlimit(resource.RLIMIT_NOFILE, _given())
