"""Where and as whom this process works, which every result depends on; told without a look at any file."""

from __future__ import annotations

import os
import sys

TYPE_CHECKING = False  # `typing` costs more than this module, which every start imports
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

# Variables that libraries in C, or the interpreter, read by themselves.
_READ_BY_ALL = ("LANG", "LC_ALL", "LC_CTYPE", "LC_MESSAGES", "TZ", "PYTHONHASHSEED", "PYTHONWARNINGS")


def standing(environment: Mapping[str, str]) -> Iterator[str]:
    """Yield interpreter, working folder, import path, machine, processors, user, and what libraries go by.

    Raises `OSError` where the working folder is gone.
    """
    yield sys.version
    yield sys.executable
    yield os.getcwd()
    yield from sys.path
    yield from os.uname()
    yield str(sorted(os.sched_getaffinity(0)))
    yield str(os.getuid())
    yield from (f"{name}={environment.get(name)}" for name in _READ_BY_ALL)
