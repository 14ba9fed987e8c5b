"""How a plan gets from the command line to the supervisor."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from orchestra.cli.boundary import Telling, guarded
from orchestra.cli.run_options import run_options
from orchestra.control.entrance import afterwards, attend
from orchestra.supervise import document
from orchestra.supervise.run import run as run_supervised

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable
    from typing import BinaryIO

    from orchestra.plan.model import Plan
    from orchestra.supervise.serving import Answer


def hand_over(
    plan: Plan, options: Namespace, default_name: str, stream: BinaryIO, *, files: str | None = None
) -> None:
    """Write the plan and how to run it to the supervisor's stream. Raises `UsageError`.

    `files` is a folder that becomes part of the run directory.
    """
    stream.write(document.dumps(plan, replace(run_options(options, default_name), files=files)))


def supervised(
    command: str, prepare: Callable[[Namespace, BinaryIO], int | Answer], options: Namespace
) -> int:
    """Run what `prepare` hands over: for a command line that `orchestra.__main__` did not know for a run."""
    return run_supervised(
        lambda stream: guarded(lambda: prepare(options, stream), Telling.of(command, options)),
        attend,
        afterwards,
    )
