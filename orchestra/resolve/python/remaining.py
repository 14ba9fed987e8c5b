"""What code of launch files leaves behind: programs and threads that still run, functions for the end of the program.

None of it is part of a plan, and all of it ends with the process that reads launch files, or before. A program that is
started there as a child while nothing but this thread runs can only be the code's.
"""

from __future__ import annotations

import atexit
import os
import sys
import sysconfig
import time
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.place import here, is_own, span_in
from orchestra.resolve.command_reaper import children, has_children, kill, set_subreaper
from orchestra.witness.observing import observer

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from orchestra.location import Span

_PYTHON: Final = tuple(
    os.path.realpath(sysconfig.get_path(name)) for name in ("stdlib", "platstdlib", "purelib", "platlib")
)
_PATIENCE: Final = 0.2
_PAUSE: Final = 0.001
_TO_BEGIN: Final = 2.0  # seconds in which a program has begun, on a busy machine too


class Remaining:
    """Watches what code leaves; `functions` are those that it wants called at the end, with the place of that.

    They are called when they are `due`.
    """

    def __init__(self, *, due: bool) -> None:
        self.functions: list[tuple[Callable[[], Any], Span]] = []
        self._due = due
        self._threads = set(_threads())
        self._children = set(_children()) if len(self._threads) <= 1 else None

    def told(self, file: Callable[[], Span]) -> Iterator[tuple[str, Span]]:
        """Yield what is to be said of what is left; `file` gives the place of what has none of its own."""
        for words in self._commands():
            yield f"code has started '{words}', which is no part of the launch: it is ended now", file()
        for thread, span in self._running():
            yield f"the thread '{thread.name}' still runs: nothing waits for it", span or file()
        for function, span in [] if self._due else self.functions:
            name = getattr(function, "__qualname__", repr(function))
            yield f"{name} is not called at the end of the launch, which this process does not see", span

    def end(self) -> None:
        """Kill the programs that are left, and those that they have started."""
        while left := self._programs():
            for child in left:
                with suppress(ProcessLookupError):  # user code has waited for it since
                    kill(child)
            for child in left:
                with suppress(ChildProcessError):  # as above
                    os.waitpid(child, 0)

    def _commands(self) -> list[str]:
        """Return the command lines of programs that do not end soon, when they have become what they are."""
        deadline = time.monotonic() + _PATIENCE
        while (found := [words for child in self._programs() if (words := _words(child))]) and (
            time.monotonic() < deadline
        ):
            time.sleep(_PATIENCE / 20)
        return found

    def _programs(self) -> list[int]:
        known = self._children
        return [] if known is None else [child for child in _children() if child not in known]

    def _running(self) -> Iterator[tuple[Any, Span | None]]:
        """Yield the threads of users' code that do not end soon, and where it is that they run."""
        for thread in _threads():
            code = _code_of(thread)
            if thread in self._threads or (code is not None and _is_installed(code.co_filename)):
                continue
            thread.join(_PATIENCE)
            if thread.is_alive():
                at = None if code is None else span_in(code.co_filename, (code.co_firstlineno, *[None] * 3))
                yield thread, at


@contextmanager
def nothing_left(*, launching: bool) -> Iterator[Remaining]:
    """Let code run for a while. Functions for the end are called then, unless more than a plan is made of it."""
    found = Remaining(due=not launching)
    try:
        with _collecting(found.functions):
            yield found
    finally:
        for function, _ in [] if launching else reversed(found.functions):
            try:
                function()
            except Exception:  # noqa: BLE001 - as the interpreter does at its end
                sys.excepthook(*sys.exc_info())
        with observer().aside():
            found.end()


@contextmanager
def orphans_kept() -> Iterator[None]:
    """Let programs whose parent has ended be children of this process for a while: some have parents that end early."""
    before = set_subreaper(1)
    try:
        yield
    finally:
        set_subreaper(before)


@contextmanager
def _collecting(functions: list[tuple[Callable[[], Any], Span]]) -> Iterator[None]:
    """Keep what code, and no library, wants to be called at the end of the program."""
    register, unregister = atexit.register, atexit.unregister

    def collect(function: Any, *args: Any, **kwargs: Any) -> Any:
        if _is_installed(sys._getframe(1).f_code.co_filename):
            return register(function, *args, **kwargs)
        functions.append((_Call(function, args, kwargs), here().span))
        return function

    def drop(function: Any) -> None:
        functions[:] = [item for item in functions if getattr(item[0], "function", None) != function]
        unregister(function)

    module: Any = atexit
    module.register, module.unregister = collect, drop
    try:
        yield
    finally:
        module.register, module.unregister = register, unregister


class _Call:
    """A function with what it is to be called with."""

    def __init__(self, function: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
        self.function = function
        self.__qualname__ = getattr(function, "__qualname__", repr(function))
        self._args = args
        self._kwargs = kwargs

    def __call__(self) -> None:
        self.function(*self._args, **self._kwargs)


def _children() -> list[int]:
    """Return the children of this process, from where the kernel lists them, where it does."""
    if not has_children():
        return []
    try:
        return [child for task in os.listdir("/proc/self/task") for child in _children_of(task)]  # noqa: PTH208 - no paths are wanted
    except OSError:
        return children()


def _children_of(task: str) -> list[int]:
    with open(f"/proc/self/task/{task}/children", "rb") as file:  # noqa: PTH123 - pathlib is slow
        return [int(child) for child in file.read().split()]


def _threads() -> list[Any]:
    threading = sys.modules.get("threading")
    return [] if threading is None else threading.enumerate()


def _code_of(thread: Any) -> Any:
    """Return the code that a thread runs; None where that is not Python."""
    function = getattr(thread, "_target", None) or thread.run
    return getattr(getattr(function, "__func__", function), "__code__", None)


def _is_installed(file: str) -> bool:
    return is_own(file) or file.startswith("<") or os.path.realpath(file).startswith(_PYTHON)


def _words(child: int) -> str | None:
    """Return the command line of a process, its name where it has none; None for one that has ended."""
    try:
        with open(f"/proc/{child}/stat", "rb") as file:  # noqa: PTH123 - pathlib is slow
            name, _, rest = file.read().decode(errors="replace").rpartition(")")
        words = _command_line(child)
    except OSError:
        return None
    return None if rest.split()[0] == "Z" else words or name.partition("(")[2]


def _command_line(child: int) -> str:
    """Return it with blanks, empty where there is none.

    It is empty for a moment, too, where a program begins: the kernel tells whoever started it before it has put the
    words in their place (execve(2)).
    """
    until = time.monotonic() + _TO_BEGIN
    while True:
        with open(f"/proc/{child}/cmdline", "rb") as file:  # noqa: PTH123 - as above
            words = file.read().replace(b"\0", b" ").decode(errors="replace").strip()
        if words or not os.path.exists(f"/proc/{child}/exe") or time.monotonic() > until:  # noqa: PTH110 - as above
            return words
        time.sleep(_PAUSE)
