"""`orchestra launch`: start what a launch file describes, watch it, stop it."""

from __future__ import annotations

import sys
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from orchestra.cli import boundary, inputs, run_options
from orchestra.cli.parser import CommandParser
from orchestra.cli.problems.formats import FORMATS

if TYPE_CHECKING:
    from argparse import Namespace
    from typing import BinaryIO

    from orchestra.pipeline import Launch
    from orchestra.supervise.resolver.serving import Answer


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser("launch", "Start what a launch file describes, watch it, stop it.", inputs.EPILOG)
    inputs.add_to(made)
    made.add_argument(
        "--format",
        choices=FORMATS,
        default="text",
        help="how problems are shown (default: text)",
    )
    run_options.add_to(made)
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
    # What each of the three needs is heavy, and `--help` and the other two do not need it.
    if options.show_args:
        from orchestra.cli.arguments import show_arguments  # noqa: PLC0415

        return show_arguments(options)
    if options.print_plan:
        from orchestra.plan.render.formats import FORMATS as PLAN_FORMATS  # noqa: PLC0415

        plan = inputs.plan_from(options, launching=False)
        inputs.warn(plan, options)
        sys.stdout.write(PLAN_FORMATS["text"](plan))
        return boundary.OK
    from orchestra.cli.handover import supervised  # noqa: PLC0415

    return supervised("launch", prepare, options)


def prepare(options: Namespace, stream: BinaryIO) -> int | Answer:
    """Make the plan and hand it to the supervisor; its warnings go to standard error.

    Where code of the launch files decides about something in the run, what is returned asks it.
    """
    from orchestra.cli.handover import hand_over, warn  # noqa: PLC0415 - heavy, and only a run needs it

    with ExitStack() as lasting:
        launch = inputs.launch_from(options, lasting)
        warn(launch.plan, options)
        name = Path(launch.plan.file).name.partition(".")[0]
        hand_over(launch.plan, options, name, stream, files=launch.files.keep(more=launch.deferred))
        if launch.deferred:
            return partial(_answer, lasting.pop_all(), launch)
    return boundary.OK


def _answer(lasting: ExitStack, launch: Launch, question: dict[str, Any]) -> dict[str, Any]:
    """Ask code of the launch files, which can be called as long as somebody holds `lasting`."""
    del lasting
    return launch.answer(question)
