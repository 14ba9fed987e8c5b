"""`orchestra plan`: show what a launch file would start, and start nothing."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from orchestra.cli import boundary, inputs
from orchestra.cli.parser import CommandParser
from orchestra.plan.render.formats import FORMATS

if TYPE_CHECKING:
    from argparse import Namespace


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser("plan", "Show what a launch file would start, and start nothing.", inputs.EPILOG)
    made.add_argument(
        "--format", choices=sorted(FORMATS), default="text", help="how to show it (default: text)"
    )
    inputs.add_to(made)
    return made


def run(options: Namespace) -> int:
    """Print the plan on standard output; in text, its warnings go to standard error."""
    plan = inputs.plan_from(options)
    if options.format == "text":
        boundary.show_problems(plan.problems, "text", sys.stderr)
    sys.stdout.write(FORMATS[options.format](plan))
    return boundary.OK
