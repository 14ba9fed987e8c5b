"""`orchestra plan`: show what a launch file would start, and start nothing."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from orchestra.cli import boundary, inputs
from orchestra.cli.parser import CommandParser

if TYPE_CHECKING:
    from argparse import Namespace


FORMATS = ("json", "text")


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser("plan", "Show what a launch file would start, and start nothing.", inputs.EPILOG)
    made.add_argument("--format", choices=FORMATS, default="text", help="how to show it (default: text)")
    inputs.add_to(made)
    return made


def run(options: Namespace) -> int:
    """Print the plan on standard output; its warnings, in text, and all errors go to standard error."""
    from orchestra.plan.render import formats  # noqa: PLC0415 - heavy, and `--help` does not need it

    plan = inputs.plan_from(options, launching=False)
    if options.format == "text":  # in JSON they are part of the plan
        inputs.warn(plan, options)
    sys.stdout.write(formats.FORMATS[options.format](plan))
    return boundary.OK
