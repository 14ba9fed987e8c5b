"""`orchestra run`: start one node."""

from __future__ import annotations

import argparse
import os
from typing import TYPE_CHECKING

from orchestra.cli import boundary, run_options
from orchestra.cli.parser import CommandParser
from orchestra.errors import UsageError

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Sequence
    from typing import BinaryIO

_EPILOG = "All words after the executable go to the node unchanged."


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser("run", "Start one node.", _EPILOG, intermixed=False)
    run_options.add_to(made)
    made.add_argument(
        "--prefix", default="", metavar="COMMAND", help="a command to run the node with: 'gdb --args'"
    )
    made.add_argument(
        "words", nargs=argparse.REMAINDER, metavar="PACKAGE EXECUTABLE [WORD ...]", help="see below"
    )
    return made


def run(options: Namespace) -> int:
    """Run the node."""
    from orchestra.cli.handover import supervised  # noqa: PLC0415 - heavy, and `--help` does not need it

    return supervised("run", prepare, options)


def prepare(options: Namespace, stream: BinaryIO, words: Sequence[str] = ()) -> int:
    """Make the plan of the one node and hand it to the supervisor."""
    del words  # there is nothing to be remembered: one node is found at once
    if len(options.words) < 2:  # noqa: PLR2004 - a package and an executable
        raise UsageError("a package and an executable are wanted")
    # Both are heavy, and `--help` does not need them.
    from orchestra import pipeline  # noqa: PLC0415
    from orchestra.cli.handover import document_of, warnings_of  # noqa: PLC0415

    package, executable, *arguments = options.words
    given = pipeline.inputs_from((), environment=os.environ)
    plan = pipeline.plan_of_node(package, executable, arguments, given, prefix=options.prefix)
    boundary.tell(warnings_of(plan, options))
    stream.write(document_of(plan, options, executable))
    return boundary.OK
