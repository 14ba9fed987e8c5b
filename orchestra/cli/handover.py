"""How a plan gets from the command line to the supervisor, and the options that say how to run it."""

from __future__ import annotations

import dataclasses
import re
from typing import TYPE_CHECKING

from orchestra.cli.boundary import Telling, guarded
from orchestra.supervise import document
from orchestra.supervise.options import RunOptions
from orchestra.supervise.run import run as run_supervised

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Callable
    from typing import BinaryIO

    from orchestra.plan.model import Plan


def add_run_options(parser: ArgumentParser) -> None:
    """Let a parser read how to run."""
    parser.add_argument("--name", metavar="RUN", help="a name for the run directory (default: from the file)")
    parser.add_argument(
        "--fail-on",
        choices=("required", "any"),
        default="required",
        help="whose failure makes the run fail (default: required)",
    )
    parser.add_argument(
        *("-a", "--show-all-subprocesses-output"),
        dest="show_all",
        action="store_true",
        help="show the output of every process, whatever the description says",
    )
    parser.add_argument("-d", "--debug", action="store_true", help="show the traceback of a bug in Orchestra")
    parser.add_argument(
        *("-n", "--noninteractive"),
        action="store_true",
        help="accepted as by ros2 launch; nothing here depends on a terminal",
    )


def run_options(options: Namespace, default_name: str) -> RunOptions:
    """Return how to run; a name becomes one that any file system takes."""
    name = re.sub(r"[^\w.-]+", "_", options.name or default_name).strip("._")
    return RunOptions(name=name or "run", fail_on_any=options.fail_on == "any")


def hand_over(plan: Plan, options: Namespace, default_name: str, stream: BinaryIO) -> None:
    """Write the plan and how to run it to the supervisor's stream."""
    if options.show_all:
        processes = tuple(dataclasses.replace(process, output="both") for process in plan.processes)
        plan = dataclasses.replace(plan, processes=processes)
    stream.write(document.dumps(plan, run_options(options, default_name)))


def supervised(command: str, prepare: Callable[[Namespace, BinaryIO], int], options: Namespace) -> int:
    """Run what `prepare` hands over: for a command line that `orchestra.__main__` did not know for a run."""
    return run_supervised(
        lambda stream: guarded(lambda: prepare(options, stream), Telling.of(command, options))
    )
