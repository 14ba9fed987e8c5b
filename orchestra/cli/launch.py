"""`orchestra launch`: start what a launch file describes, watch it, stop it."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.cli import boundary, inputs
from orchestra.cli.arguments import arguments_text
from orchestra.cli.handover import add_run_options, hand_over, supervised
from orchestra.cli.parser import CommandParser
from orchestra.cli.problems.formats import FORMATS
from orchestra.plan.render.formats import FORMATS as PLAN_FORMATS

if TYPE_CHECKING:
    from argparse import Namespace
    from typing import BinaryIO


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser("launch", "Start what a launch file describes, watch it, stop it.", inputs.EPILOG)
    inputs.add_to(made)
    made.add_argument(
        "--format",
        choices=sorted(FORMATS),
        default="text",
        help="how problems are shown (default: text)",
    )
    add_run_options(made)
    showing = made.add_mutually_exclusive_group()
    showing.add_argument(
        *("-s", "--show-args", "--show-arguments"),
        dest="show_args",
        action="store_true",
        help="show the arguments of the launch file and start nothing",
    )
    showing.add_argument(
        *("-p", "--print", "--print-description"),
        dest="print_plan",
        action="store_true",
        help="show the plan and start nothing",
    )
    return made


def run(options: Namespace) -> int:
    """Show what was asked for, else run the plan."""
    if options.show_args:
        sys.stdout.write(arguments_text(inputs.plan_from(options, launching=False, required=False)))
        return boundary.OK
    if options.print_plan:
        sys.stdout.write(PLAN_FORMATS["text"](inputs.plan_from(options, launching=False)))
        return boundary.OK
    return supervised("launch", prepare, options)


def prepare(options: Namespace, stream: BinaryIO) -> int:
    """Make the plan and hand it to the supervisor; its warnings go to standard error."""
    plan = inputs.plan_from(options, launching=True)
    inputs.warn(plan, options)
    hand_over(plan, options, Path(plan.file).name.partition(".")[0], stream)
    return boundary.OK
