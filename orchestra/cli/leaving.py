"""The end of a command that launches nothing: what code of launch files leaves running ends with it."""

from __future__ import annotations

import atexit
import os
import sys
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator
    from threading import Thread


@contextmanager
def contained(*, inheriting: bool = False) -> Iterator[None]:
    """Kill the processes that have been started meanwhile and are still there, and those that they have started.

    Where code runs in this process it inherits what they leave behind (`resolve.python.isolation`); `inheriting`: it
    does so all the time, as it has others in which code runs.
    """
    # Here, because only commands that read launch files need it.
    from orchestra.resolve.command_reaper import children, set_subreaper  # noqa: PLC0415
    from orchestra.witness.observing import observer  # noqa: PLC0415

    with observer().aside():  # it decides nothing about a plan that is to be kept
        known = set(children())
        before = set_subreaper(1) if inheriting else None
    try:
        yield
    finally:
        with observer().aside():
            _end_all_but(known)
            if before is not None:
                set_subreaper(before)


def _end_all_but(known: set[int]) -> None:
    from orchestra.resolve.command_reaper import children, kill, set_subreaper  # noqa: PLC0415 - as above

    before = None
    while left := [child for child in children() if child not in known]:
        if before is None:  # what they have started is this process's as soon as they are gone
            before = set_subreaper(1)
        for child in left:
            with suppress(ProcessLookupError):  # user code has waited for it since
                kill(child)
        for child in left:
            with suppress(ChildProcessError):  # as above
                os.waitpid(child, 0)
    if before is not None:
        set_subreaper(before)


def threads() -> set[Thread]:
    """Return the threads for which the interpreter would wait before it ends."""
    threading = sys.modules.get("threading")
    if threading is None:
        return set()
    return {
        thread
        for thread in threading.enumerate()
        if not thread.daemon and thread is not threading.main_thread()
    }


def end_at_once(status: int) -> None:
    """End this process without waiting for threads."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError):  # nobody reads it any more
            stream.flush()
    os._exit(status)


def spare(*made: object) -> None:
    """Keep what a command has made until its process ends: to take a large plan apart costs a third of showing it."""
    _spared[:] = made


_spared: list[object] = []


def end_untidied(status: int) -> None:
    """End this process as the interpreter does, but for taking apart each of its objects.

    Where somebody looks on, as a debugger, a profiler, or who counts what tests reach, it returns and does nothing.
    """
    if _is_looked_at():
        return
    atexit._run_exitfuncs()  # noqa: SLF001 - there is no other way, and nothing is called twice
    try:
        sys.stdout.flush()
        sys.stderr.flush()
    except (OSError, ValueError):  # the interpreter has a status of its own for that
        return
    os._exit(status)


_MOST_TOOLS = 6


def _is_looked_at() -> bool:
    monitoring: Any = getattr(sys, "monitoring", None)  # since 3.12
    tools = map(monitoring.get_tool, range(_MOST_TOOLS)) if monitoring else ()
    return bool(sys.flags.inspect or sys.gettrace() or sys.getprofile() or any(tools))
