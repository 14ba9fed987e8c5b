"""How a plan gets from the command line to the supervisor."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.cli import inputs
from orchestra.cli.boundary import Telling, guarded
from orchestra.cli.run_options import run_options
from orchestra.cli.starting import started
from orchestra.errors import DescriptionError, Severity
from orchestra.fields import replace
from orchestra.supervise.keeping.marks import RUN
from orchestra.supervise.resolver import document

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable
    from typing import BinaryIO

    from orchestra.errors import Problem
    from orchestra.plan.model import Plan
    from orchestra.supervise.resolver.serving import Answer, Settled


def document_of(plan: Plan, options: Namespace, default_name: str, *, files: str | None = None) -> bytes:
    """Return the plan and how to run it, as the supervisor reads it. Raises `UsageError`.

    `files` is a folder that becomes part of the run directory.
    """
    return document.dumps(plan, replace(run_options(options, default_name), files=files))


def warnings_of(plan: Plan, options: Namespace) -> str:
    """Return the warnings of a plan that is to be run, those about its limits on this machine among them.

    Raises `DescriptionError` where this machine cannot grant the limits; the supervisor would refuse them in plainer
    words.
    """
    unfit = _unfit(plan)
    problems = inputs.as_errors(unfit) if getattr(options, "strict", False) else unfit
    everything = (*plan.problems, *problems)
    if any(problem.severity is Severity.ERROR for problem in problems):
        raise DescriptionError(everything)
    return inputs.warnings_text(everything, options)


def _unfit(plan: Plan) -> tuple[Problem, ...]:
    if all(process.limits is None for process in plan.processes):
        return ()
    from orchestra.supervise.limits.confines import checked  # noqa: PLC0415 - few plans have limits

    return checked(plan, os.environ[RUN])


def supervised(
    command: str, prepare: Callable[[Namespace, BinaryIO], int | Answer | Settled], options: Namespace
) -> int:
    """Run what `prepare` hands over: for a command line that `orchestra.__main__` did not know for a run."""
    return started(
        lambda stream: guarded(lambda: prepare(options, stream), Telling.of(command, options)),
        detach=options.detach,
        wait_ready=options.wait_ready,
    )
