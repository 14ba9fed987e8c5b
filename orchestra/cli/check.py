"""`orchestra check`: find what is wrong in launch files and parameter files, and start nothing."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Any, Final

from orchestra.cli import boundary, severities
from orchestra.cli.inputs import as_errors
from orchestra.cli.leaving import contained
from orchestra.cli.plain import plain
from orchestra.cli.problems.formats import FORMATS
from orchestra.errors import Severity, UsageError
from orchestra.fields import replace

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Sequence

    from orchestra.cli.checking import Checked
    from orchestra.cli.parser import CommandParser

_EPILOG = """\
A file is checked whatever it is called. In a folder, and the folders below it, these are checked: files whose name
ends in .launch, or in launch.py, .xml, .yaml or .yml behind a dot, line or underline; Python, XML and YAML files whose
text is that of a launch file; and YAML files with `ros__parameters`. A package stands for its share folder, PACKAGE
FILE and PACKAGE/NAME for one of its launch files, as for `orchestra launch`. What only this machine lacks is a note.
The exit status is 0, or 2 where there is an error.
"""


_NOTES: Final = ("brief", "all", "none")


def parser() -> CommandParser:
    """Return what the command understands."""
    # Slow, and of no use where the options are plain.
    from orchestra.cli.parser import CommandParser  # noqa: PLC0415

    made = CommandParser("check", "Find what is wrong in launch files and parameter files.", _EPILOG)
    _add_to(made)
    return made


def read(words: Sequence[str]) -> Any:  # noqa: ANN401 - what argparse makes of them
    """Return the options that words are. Raises `UsageError`, or `SystemExit` after `--help`."""
    return plain(words, _add_to) or parser().read(words)


def _add_to(made: Any) -> None:  # noqa: ANN401 - argparse's parser, or what stands for it
    made.add_argument(
        "words",
        nargs="*",
        metavar="PATH | PACKAGE [FILE] | NAME:=VALUE",
        help="files, folders, packages, launch files of packages; launch arguments",
    )
    made.add_argument("--format", choices=FORMATS, default="text", help="of the problems (default: text)")
    made.add_argument(
        "--notes",
        choices=_NOTES,
        default=_NOTES[0],
        help="on what this machine lacks: in brief behind the problems, all where they are, or none (default: brief)",
    )
    made.add_argument("--strict", action="store_true", help="take warnings for errors")
    severities.add_to(made)
    made.add_argument(
        "--no-cache", action="store_true", help="look at every file, also at those that have not changed"
    )
    made.add_argument(
        "--jobs", type=_number, metavar="N", help="processes that look at files (default: one a core)"
    )
    made.add_argument(
        "--time-limit",
        type=_seconds,
        default=120.0,
        metavar="SECONDS",
        help="how long code of one file may take (default: 120)",
    )


def _number(word: str) -> int:
    number = int(word)
    if number < 1:
        raise ValueError
    return number


def _seconds(word: str) -> float:
    seconds = float(word)
    if not 0 < seconds < float("inf"):
        raise ValueError
    return seconds


def _summary(checked: Checked) -> str:
    """Return what was looked at, and how much of it has changed. What is only noted is no problem."""
    files = f"{checked.files} file{'s' * (checked.files != 1)}"
    unchanged = f", {checked.unchanged} unchanged" if checked.unchanged else ""
    sound = all(problem.severity is Severity.NOTE for problem in checked.problems)
    return f"{'no problems in' if sound else 'looked at'} {files}{unchanged}\n"


def run(options: Namespace) -> int:
    """Print the list of problems on standard output."""
    paths = [word for word in options.words if ":=" not in word]
    if not paths:
        raise UsageError("a file or folder is missing")
    words = [word for word in options.words if ":=" in word]
    # All of them are heavy, and `--help` does not need them.
    from orchestra.cli.checking import Manner, check  # noqa: PLC0415
    from orchestra.cli.look.gathered import gathered  # noqa: PLC0415
    from orchestra.cli.places import places  # noqa: PLC0415
    from orchestra.resolve.command_line import inputs_from  # noqa: PLC0415
    from orchestra.resolve.packages import InstalledPackages  # noqa: PLC0415

    jobs, cache = options.jobs or len(os.sched_getaffinity(0)), not options.no_cache
    found, identity = gathered(places(paths, InstalledPackages(os.environ)), jobs, cache=cache)
    inputs = replace(inputs_from(words, environment=os.environ), severity=severities.given(options))
    manner = Manner(jobs, options.time_limit, cache, options.strict, identity)
    with contained(inheriting=True):
        checked = check(found, inputs, manner)
    problems = as_errors(checked.problems) if options.strict else checked.problems
    if options.notes == "none":
        problems = tuple(problem for problem in problems if problem.severity is not Severity.NOTE)
    shown = "brief" if (options.format, options.notes) == ("text", "brief") else options.format
    if problems or options.format != "text":
        boundary.show_problems(problems, shown, sys.stdout, command_line=" ".join(words))
    if options.format == "text":
        sys.stdout.write(_summary(checked))
    faulty = any(problem.severity is Severity.ERROR for problem in problems)
    return boundary.MISTAKE if faulty else boundary.OK
