"""How a plan gets from the command line to the supervisor."""

from __future__ import annotations

import os
import sys
from dataclasses import replace
from typing import TYPE_CHECKING

from orchestra.cli.boundary import Telling, guarded, show_problems
from orchestra.cli.inputs import as_errors
from orchestra.cli.run_options import run_options
from orchestra.cli.starting import started
from orchestra.errors import DescriptionError, Severity
from orchestra.supervise import document
from orchestra.supervise.marks import RUN

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable
    from typing import BinaryIO

    from orchestra.plan.model import Plan
    from orchestra.supervise.serving import Answer


def hand_over(
    plan: Plan, options: Namespace, default_name: str, stream: BinaryIO, *, files: str | None = None
) -> None:
    """Write the plan and how to run it to the supervisor's stream.

    Raises `UsageError`, and `DescriptionError` where this machine cannot grant the limits of the plan.

    `files` is a folder that becomes part of the run directory.
    """
    _check_limits(plan, options)
    stream.write(document.dumps(plan, replace(run_options(options, default_name), files=files)))


def _check_limits(plan: Plan, options: Namespace) -> None:
    """Show what stands against the limits of a plan; the supervisor would refuse the errors in plainer words."""
    if all(process.limits is None for process in plan.processes):
        return
    from orchestra.supervise.confines import checked  # noqa: PLC0415 - few plans have limits

    unfit = checked(plan, os.environ[RUN])
    problems = as_errors(unfit) if getattr(options, "strict", False) else unfit
    if any(problem.severity is Severity.ERROR for problem in problems):
        raise DescriptionError(problems)
    if problems:
        telling = Telling.of("", options)
        show_problems(problems, telling.problem_format, sys.stderr, command_line=telling.command_line)


def supervised(
    command: str, prepare: Callable[[Namespace, BinaryIO], int | Answer], options: Namespace
) -> int:
    """Run what `prepare` hands over: for a command line that `orchestra.__main__` did not know for a run."""
    return started(
        lambda stream: guarded(lambda: prepare(options, stream), Telling.of(command, options)),
        detach=options.detach,
        wait_ready=options.wait_ready,
    )
