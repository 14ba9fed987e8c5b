"""`orchestra format`: write launch files and parameter files in one form."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.cli import boundary
from orchestra.cli.parser import CommandParser
from orchestra.errors import UsageError

if TYPE_CHECKING:
    from argparse import Namespace

_EPILOG = """\
In a folder those files are formatted that 'orchestra check' finds in it. Launch files in Python are left to the
formatters of Python. A file with a syntax error is never touched. The exit status is 0, 1 where --check or --diff
finds something to change or a file cannot be written, and 2 where a file cannot be read.
"""


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser(
        "format", "Write launch files in YAML and XML, and parameter files, in one form.", _EPILOG
    )
    made.add_argument("paths", nargs="*", metavar="PATH", help="files and folders; - for standard input")
    made.add_argument(
        "--check", action="store_true", help="change nothing; name the files that would be changed"
    )
    made.add_argument("--diff", action="store_true", help="change nothing; print what would be changed")
    made.add_argument(
        "--stdin",
        metavar="NAME",
        help="format standard input as if it were the file NAME, to standard output",
    )
    made.add_argument("--line-length", type=_length, metavar="COLUMNS", help="width of lines (default: 120)")
    return made


def run(options: Namespace) -> int:
    """Format the files; print the names of those that are, or would be, changed."""
    # All of it is heavy, and `--help` does not need it.
    from orchestra.cli.formatting import Formatting, Showing  # noqa: PLC0415
    from orchestra.cli.targets import targets  # noqa: PLC0415
    from orchestra.formatting.formatted import WIDTH  # noqa: PLC0415

    standard_input = options.stdin is not None or options.paths == ["-"]
    if not options.paths and not standard_input:
        raise UsageError("a file or folder is missing")
    if standard_input and options.paths not in ([], ["-"]):
        raise UsageError("standard input is formatted alone")
    showing = Showing.DIFFERENCE if options.diff else Showing.NAMES if options.check else Showing.WRITTEN
    work = Formatting(options.line_length or WIDTH, showing)
    if standard_input:
        return work.stream(sys.stdin.buffer.read(), options.stdin)
    for target in targets(options.paths):
        work.file(Path(target.path), target.kind)
    boundary.show_problems(work.problems.ordered, "text", sys.stderr)
    sys.stderr.write(work.summary())
    return work.status()


def _length(text: str) -> int:
    length = int(text)
    if length < 1:
        raise ValueError
    return length
