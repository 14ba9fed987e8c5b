"""The one place that shows errors and turns them into exit statuses.

DescriptionError   the problems, in the format that was asked for   2
UsageError         the message, and where to read more              2
RunError           the message                                      1
KeyboardInterrupt  nothing                                          130
BrokenPipeError    nothing: whoever read the output has gone        141
anything else      a bug: a report is written to a file and named   3
"""

from __future__ import annotations

import os
import sys
import traceback
from typing import TYPE_CHECKING

from orchestra.cli import colour
from orchestra.cli.problems.formats import FORMATS
from orchestra.cli.problems.sources import from_files
from orchestra.cli.report import write_report
from orchestra.errors import DescriptionError, RunError, UsageError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import TextIO

    from orchestra.errors import Problem

OK, FAILED, MISTAKE, BUG = 0, 1, 2, 3
INTERRUPTED, BROKEN_PIPE = 130, 141


def guarded(
    work: Callable[[], int], *, command: str = "", problem_format: str = "text", debug: bool = False
) -> int:
    """Do the work of one command and return its exit status, or that of the error it ended with."""
    try:
        status = work()
        sys.stdout.flush()
    except DescriptionError as error:
        show_problems(error.problems, problem_format, sys.stderr)
        return MISTAKE
    except UsageError as error:
        _say("error", str(error))
        _say(
            "help",
            f"'orchestra {command} --help' lists what it understands"
            if command
            else "see 'orchestra --help'",
        )
        return MISTAKE
    except RunError as error:
        _say("error", str(error))
        return FAILED
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:
        _forget_output()
        return BROKEN_PIPE
    except Exception as error:  # noqa: BLE001 - whatever else ends a command is a bug, and this is where it is shown
        if debug:
            traceback.print_exception(error)
        _say("error", f"this is a bug in Orchestra: {type(error).__name__}: {error}")
        _say("help", f"please report it with the file {write_report(error)}")
        return BUG
    return status


def show_problems(problems: Sequence[Problem], problem_format: str, stream: TextIO) -> None:
    """Print problems to a stream."""
    paint = colour.painter(enabled=colour.wanted(stream, os.environ))
    stream.write(FORMATS[problem_format](problems, from_files(), paint))


def _say(kind: str, text: str) -> None:
    paint = colour.painter(enabled=colour.wanted(sys.stderr, os.environ))
    sys.stderr.write(f"{paint(kind, f'{kind}:')} {text}\n")


def _forget_output() -> None:
    """Let the interpreter's own last flush have somewhere to go (as docs.python.org advises for SIGPIPE)."""
    with open(os.devnull, "w") as nowhere:  # noqa: PTH123 - a descriptor is wanted
        os.dup2(nowhere.fileno(), sys.stdout.fileno())
