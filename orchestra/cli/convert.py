"""`orchestra convert`: write a launch file in another language."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.cli import boundary, colour, leaving, patience
from orchestra.cli.parser import CommandParser
from orchestra.errors import UsageError
from orchestra.location import is_file

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.convert.converting import Converted

LANGUAGES = ("yaml", "xml", "python")
_STREAM = "-"
_EPILOG = """\
Arguments, conditions, substitutions and comments are kept. What the other language cannot say, as an OpaqueFunction of
Python, is told with its place, and nothing is written (exit status 1); with --partial all else is.
"""


class ConversionError(Exception):
    """What was written says something else than the file: a fault of Orchestra's."""


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser("convert", "Write a launch file in another language.", _EPILOG)
    made.add_argument("file", metavar="FILE", help="the launch file")
    made.add_argument("--to", choices=LANGUAGES, required=True, help="the language to write")
    made.add_argument(
        "-o", "--output", default=_STREAM, metavar="FILE", help="where to write (default: -, standard output)"
    )
    made.add_argument("--force", action="store_true", help="write over a file that is there")
    made.add_argument(
        "--partial",
        action="store_true",
        help="write what can be converted, with a comment in place of what cannot",
    )
    made.add_argument(
        "--time-limit",
        type=_seconds,
        default=120.0,
        metavar="SECONDS",
        help="how long code of the file may take (default: 120)",
    )
    return made


def _seconds(word: str) -> float:
    seconds = float(word)
    if not 0 < seconds < float("inf"):
        raise ValueError
    return seconds


def run(options: Namespace) -> int:
    """Write the file; what there is to tell goes to standard error. Raises `UsageError`, `DescriptionError`."""
    if options.output != _STREAM and Path(options.output).exists() and not options.force:
        raise UsageError(f"{options.output} is there already: --force writes over it")
    # Heavy, and `--help` does not need them.
    from orchestra.convert.converting import convert  # noqa: PLC0415
    from orchestra.resolve.launch_files import not_there  # noqa: PLC0415

    if not is_file(options.file):
        raise not_there(options.file)

    with leaving.contained(), patience.patient(options.time_limit, options.file):
        converted = convert(
            options.file, options.to, os.environ, output=_folder(options), partial=options.partial
        )
    _tell(converted)
    if converted.mistake is not None:
        raise ConversionError(f"{options.file} was not converted as it is: {converted.mistake}")
    if converted.text is not None:
        _write(converted.text, options.output)
    return boundary.FAILED if converted.lossy else boundary.OK


def _folder(options: Namespace) -> str | None:
    """Return the folder in which the result will stand, None where it is not known."""
    return None if options.output == _STREAM else str(Path(options.output).absolute().parent)


def _tell(converted: Converted) -> None:
    paint = colour.painter(enabled=colour.wanted(sys.stderr, os.environ))
    for remark in converted.remarks:
        kind = "error" if remark.lost else "warning"
        told = f"cannot be converted: {remark.message}" if remark.lost else remark.message
        sys.stderr.write(f"{remark.span}: {paint(kind, f'{kind}:')} {told}\n")


def _write(text: str, output: str) -> None:
    if output == _STREAM:
        sys.stdout.write(text)
    else:
        Path(output).write_text(text, "utf-8")
