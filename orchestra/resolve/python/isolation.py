"""One resolution leaves its process as it was: user code may change environment, paths, modules, folder and streams."""

from __future__ import annotations

import os
import sys
import time
from contextlib import ExitStack, contextmanager, redirect_stdout, suppress
from typing import TYPE_CHECKING

from orchestra.compat.argv import Arguments
from orchestra.compat.hook import Serving, served
from orchestra.resolve.packages.python import libraries
from orchestra.resolve.python.environ import environment_now, put_environment
from orchestra.resolve.python.files import Files
from orchestra.witness.observing import observer

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from orchestra.compat.looks import Compiled
    from orchestra.resolve.python.interpreter import Interpreter
    from orchestra.resolve.python.libraries import Libraries
    from orchestra.resolve.python.remaining import Remaining


class Isolation:
    """The state of a process in which launch files are loaded; `files` are the temporary ones of their code.

    `remaining` watches what that leaves behind; None where there is no such code.
    """

    def __init__(self, serving: Serving, *, launching: bool) -> None:
        self.files = Files()
        self.remaining: Remaining | None = None
        self._serving = serving
        self._launching = launching
        self._restoring, self._lasting = ExitStack(), ExitStack()
        self._before: tuple[Libraries, Interpreter] | None = None
        self._folder = os.getcwd()  # noqa: PTH109 - pathlib is slow
        self._zone = time.tzname
        self._has_begun = False

    def prepare(self, code: Compiled | None = None) -> None:
        """Get ready for code of launch files, which may do anything unless it can be seen to change nothing."""
        if self.remaining is not None:
            return
        # Here, because only such code needs it, and what it imports.
        from orchestra.compat.place import forget  # noqa: PLC0415

        if not self._has_begun:
            forget()
            self._has_begun = True
        if code is not None and code.may("harmless"):
            observer().harmless = code.code
            return
        from orchestra.pyyaml import in_place  # noqa: PLC0415
        from orchestra.resolve.python.interpreter import Interpreter  # noqa: PLC0415
        from orchestra.resolve.python.libraries import Libraries  # noqa: PLC0415
        from orchestra.resolve.python.remaining import nothing_left, orphans_kept  # noqa: PLC0415
        from orchestra.resolve.python.temporary import temporary_files  # noqa: PLC0415

        in_place()
        enter = self._restoring.enter_context
        with observer().aside():
            if self._before is None:
                self._before = Libraries(), Interpreter()
                self._lasting.enter_context(orphans_kept())
                self._lasting.callback(_write_out)
            for state in self._before:
                enter(state.kept())
            enter(temporary_files(self.files))
            self.remaining = enter(nothing_left(launching=self._launching))

    def renew(self, environment: Mapping[str, str]) -> None:
        """Make this process what it was before code has run in it, for the next launch file.

        `environment` is the one for that. What is not asked for by one that has no code waits until it is.
        """
        self._restoring.close()
        _forget_loggers()
        self._serving.renew()
        sys.stdout = sys.stderr
        with suppress(OSError):  # as below
            os.dup2(2, 1)
        os.chdir(self._folder)
        put_environment(environment)
        _put_zone(self._zone)
        self.files, self.remaining, self._has_begun = Files(), None, False

    def close(self) -> None:
        """Make this process what it was."""
        with self._lasting:
            self._restoring.close()


@contextmanager
def isolated(
    environment: Mapping[str, str], argv: Sequence[str], *, launching: bool = False
) -> Iterator[Isolation]:
    """Let launch files in Python be loaded: `os.environ` is `environment`, `sys.argv` are the words of `ros2 launch`.

    What they print goes to standard error, for standard output carries the product of the command; so does what the
    programs write that they start themselves. `launching`: more than a plan is made of it.
    """
    with ExitStack() as restoring:
        restoring.callback(_put_zone, time.tzname)
        restoring.callback(put_environment, environment_now())
        restoring.callback(os.chdir, os.getcwd())  # noqa: PTH109 - pathlib is slow
        restoring.callback(_put_list, sys.path, list(sys.path))
        restoring.callback(setattr, sys, "argv", sys.argv)
        restoring.enter_context(redirect_stdout(sys.stderr))
        restoring.enter_context(_programs_redirected())
        serving = restoring.enter_context(served(lambda: isolation.remaining is None))
        restoring.callback(_forget_loggers)
        isolation = Isolation(serving, launching=launching)
        restoring.callback(isolation.close)
        put_environment(environment)
        sys.argv = Arguments(argv)
        sys.path += libraries(environment)
        yield isolation


@contextmanager
def _programs_redirected() -> Iterator[None]:
    """Let standard output be standard error for programs that are started meanwhile; nothing where one is closed."""
    with ExitStack() as restoring:
        with suppress(OSError):  # one of the two is closed: then there is nothing to keep clean
            kept = os.dup(1)
            restoring.callback(os.close, kept)
            os.dup2(2, 1)
            restoring.callback(os.dup2, kept, 1)
        yield


def _write_out() -> None:
    """Have what code has told the C library written, while it goes where other words of code go."""
    import ctypes  # noqa: PLC0415 - slow, and not needed before code has run

    with observer().aside():
        ctypes.CDLL(None).fflush(None)


def _put_zone(before: tuple[str, str]) -> None:
    """Go by the zone of the environment again, where code has gone by another one."""
    if time.tzname != before:
        time.tzset()


def _forget_loggers() -> None:
    """Undo what launch files have set for the loggers of `launch.logging`, where one has used them."""
    module = sys.modules.get("orchestra.compat.launch.logging")
    if module is not None:
        module.reset()


def _put_list(target: list[str], content: list[str]) -> None:
    target[:] = content
