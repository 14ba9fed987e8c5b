"""The one place that shows errors and turns them into exit statuses.

DescriptionError   the problems, in the format that was asked for   2
UsageError         the message, and where to read more              2
RunError           the message                                      1
KeyboardInterrupt  nothing                                          130
EndedError         nothing: SIGTERM, SIGHUP                         143, 129
BrokenPipeError    nothing: whoever read the output has gone        141
OSError            the reason the system gives, and the file        1
anything else      a bug: a report is written to a file and named   3
"""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, TypeVar

from orchestra.cli import colour, launch_prefix
from orchestra.cli.problems.formats import FORMATS
from orchestra.dataclass import dataclass
from orchestra.errors import DescriptionError, RunError, UsageError

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable, Mapping, Sequence
    from typing import TextIO

    from orchestra.errors import Problem

OK, FAILED, MISTAKE, BUG = 0, 1, 2, 3
INTERRUPTED, BROKEN_PIPE = 130, 141
_SIGNALLED = 128

_ResultT = TypeVar("_ResultT")


class EndedError(KeyboardInterrupt):
    """A signal wants the command to end: it goes through code of launch files where an interruption does."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.status = _SIGNALLED + number


@dataclass(frozen=True, slots=True)
class Telling:
    """How the errors of one command are told.

    `command_line` is the text that problems of the command line point into, `debug` asks for the traceback of a bug.
    """

    command: str = ""
    problem_format: str = "text"
    command_line: str = ""
    debug: bool = False

    @classmethod
    def of(cls, command: str, options: Namespace) -> Telling:
        """Return how the errors of a command with these options are told."""
        words = [word for word in getattr(options, "words", ()) if ":=" in word or command == "run"]
        files = [f"--params-file {file}" for file in getattr(options, "params_file", ())]
        given = " ".join([*words, *launch_prefix.words(options), *files])
        asked = getattr(options, "format", "text")
        told = asked if asked in FORMATS else "text"  # a plan has forms that problems have not
        return cls(command, told, given, getattr(options, "debug", False))


def guarded(work: Callable[[], _ResultT], telling: Telling) -> _ResultT | int:
    """Do the work of one command and return its exit status, or that of the error it ended with."""
    _open_closed_streams()
    try:
        result = work()
        sys.stdout.flush()
    except DescriptionError as error:
        tell(
            problems_text(
                error.problems, telling.problem_format, sys.stderr, command_line=telling.command_line
            )
        )
        return MISTAKE
    except UsageError as error:
        _say("error", str(error))
        words = ("orchestra", telling.command, "--help")
        _say("help", f"see '{' '.join(word for word in words if word)}'")
        return MISTAKE
    except RunError as error:
        _say("error", str(error))
        return FAILED
    except KeyboardInterrupt as error:
        return error.status if isinstance(error, EndedError) else INTERRUPTED
    except BrokenPipeError:
        _forget(sys.stdout)
        return BROKEN_PIPE
    except OSError as error:
        # The machine says no: no space, no permission. That is the user's to know, and no bug.
        _say("error", _refusal(error))
        _forget(sys.stdout)
        return FAILED
    except Exception as error:  # noqa: BLE001 - whatever else ends a command is a bug, and this is where it is shown
        _show_bug(error, debug=telling.debug)
        return BUG
    return result


def _refusal(error: OSError) -> str:
    """Return what the machine says."""
    if isinstance(error, FileNotFoundError) and not error.filename:
        try:
            os.getcwd()  # noqa: PTH109 - pathlib is slow to import
        except FileNotFoundError:
            return "the folder in which this was started is not there any more"
    return f"{error.strerror or error}" + (f": {error.filename}" if error.filename else "")


def show_problems(
    problems: Sequence[Problem],
    problem_format: str,
    stream: TextIO,
    *,
    command_line: str = "",
    texts: Mapping[str, str] | None = None,
) -> None:
    """Print problems to a stream: see `problems_text`."""
    stream.write(problems_text(problems, problem_format, stream, command_line=command_line, texts=texts))


def problems_text(
    problems: Sequence[Problem],
    problem_format: str,
    stream: TextIO,
    *,
    command_line: str = "",
    texts: Mapping[str, str] | None = None,
) -> str:
    """Return the text that shows problems on a stream.

    `command_line` is the text that those of the command line point into, `texts` has what stands in files that are not
    read from the disk.
    """
    # `orchestra --help` should be fast, and it has no problems.
    from orchestra.cli.problems.formats import renderer  # noqa: PLC0415
    from orchestra.cli.problems.sources import from_files  # noqa: PLC0415
    from orchestra.resolve.command_line import COMMAND_LINE  # noqa: PLC0415

    paint = colour.painter(enabled=colour.wanted(stream, os.environ))
    sources = from_files({COMMAND_LINE: command_line, **(texts or {})})
    return renderer(problem_format)(problems, sources, paint)


def _show_bug(error: Exception, *, debug: bool) -> None:
    from orchestra.cli.report import traceback_of, write_report  # noqa: PLC0415 - there is none, most of the time

    if debug:
        tell(traceback_of(error))
    _say("error", f"this is a bug in Orchestra: {type(error).__name__}: {error}")
    _say("help", f"please report it with the file {write_report(error)}")


def _say(kind: str, text: str) -> None:
    paint = colour.painter(enabled=colour.wanted(sys.stderr, os.environ))
    tell(f"{paint(kind, f'{kind}:')} {text}\n")


def tell(text: str) -> None:
    """Write to standard error. That nobody reads it, or that it is full, changes nothing of what is done."""
    try:
        sys.stderr.write(text)
    except OSError:
        _forget(sys.stderr)


def _open_closed_streams() -> None:
    """Give standard streams that the caller has closed somewhere to go."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w"))  # noqa: PTH123, SIM115 - it lives as long as the process


def _forget(stream: TextIO) -> None:
    """Let the interpreter's own last flush have somewhere to go (as docs.python.org advises for SIGPIPE)."""
    with open(os.devnull, "w") as nowhere:  # noqa: PTH123 - a descriptor is wanted
        os.dup2(nowhere.fileno(), stream.fileno())
