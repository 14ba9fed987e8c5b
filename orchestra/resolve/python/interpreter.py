"""The interpreter stays as it was: what code of launch files may set in it, by the functions that read and write it.

Nothing is imported for that: what has not been imported cannot have been changed before, and is put back to how it
begins if the code has imported it.
"""

from __future__ import annotations

import builtins
import os
import signal
import sys
import warnings
from _locale import LC_ALL, setlocale

# What `signal` has makes a member of an enumeration of each number first, which takes twenty times as long.
from _signal import getsignal  # type: ignore[import-not-found] # it is there wherever `signal` is
from contextlib import contextmanager, suppress
from operator import is_
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterator, MutableMapping

# Attributes of `sys` that hold one object, and those that hold a list, which others may have taken hold of.
_OBJECTS: Final = ("breakpointhook", "displayhook", "excepthook", "stderr", "stdin", "unraisablehook")
_LISTS: Final = ("meta_path", "path", "path_hooks", "warnoptions")


class Interpreter:
    """What the interpreter is when this is made."""

    def __init__(self) -> None:
        self._objects = {name: getattr(sys, name) for name in _OBJECTS}
        self._lists = {name: (getattr(sys, name), list(getattr(sys, name))) for name in _LISTS}
        self._limits = sys.getrecursionlimit(), sys.getswitchinterval(), sys.get_int_max_str_digits()
        self._tracing = sys.gettrace(), sys.getprofile()
        self._names, self._locale = dict(vars(builtins)), setlocale(LC_ALL)
        self._environ, self._mask, self._handlers = os.environ, os.umask(0), _handlers()
        os.umask(self._mask)

    @contextmanager
    def kept(self) -> Iterator[None]:
        """Let code change the interpreter for a while."""
        try:
            with warnings.catch_warnings():
                yield
        finally:
            self._put_back()

    def _put_back(self) -> None:
        os.environ = self._environ  # noqa: B003 - the object, where code has put another one in its place
        for name, value in self._objects.items():
            setattr(sys, name, value)
        for name, (value, content) in self._lists.items():
            value[:] = content
            setattr(sys, name, value)
        sys.setrecursionlimit(self._limits[0])
        sys.setswitchinterval(self._limits[1])
        sys.set_int_max_str_digits(self._limits[2])
        if (sys.gettrace(), sys.getprofile()) != self._tracing:
            sys.settrace(self._tracing[0])
            sys.setprofile(self._tracing[1])
        put_back(vars(builtins), self._names)
        if setlocale(LC_ALL) != self._locale:
            setlocale(LC_ALL, self._locale)
        os.umask(self._mask)
        _put_handlers(self._handlers)


def put_back(table: MutableMapping[str, Any], content: MutableMapping[str, Any]) -> None:
    """Make a table what it was."""
    if table.keys() == content.keys() and all(map(is_, map(table.get, content), content.values())):
        return
    for name in [name for name in table if name not in content]:
        del table[name]
    for name, value in content.items():
        if table.get(name) is not value:
            table[name] = value


def _handlers() -> dict[int, Any]:
    """Return what is done about each signal."""
    return {number: getsignal(number) for number in range(1, signal.NSIG)}


def _put_handlers(before: dict[int, Any]) -> None:
    for number, handler in _handlers().items():
        if handler is not before[number] and handler != before[number] and before[number] is not None:
            with suppress(ValueError):  # another thread than the main one cannot have changed it either
                signal.signal(number, before[number])
