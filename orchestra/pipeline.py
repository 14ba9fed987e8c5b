"""The table of contents: a launch file is loaded, resolved and planned; the supervisor then runs the plan."""

from __future__ import annotations

import gc
import os
from contextlib import contextmanager
from typing import TYPE_CHECKING

from orchestra.errors import DescriptionError, Problem, Problems
from orchestra.load.files import load
from orchestra.plan.build import build
from orchestra.resolve import launch_files
from orchestra.resolve.command_line import inputs_from
from orchestra.resolve.commands import run_command
from orchestra.resolve.packages import InstalledPackages
from orchestra.resolve.resolve import resolve
from orchestra.resolve.single import single_node

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.plan.model import Plan
    from orchestra.resolve.inputs import Inputs
    from orchestra.resolve.resolution import LoadFile


__all__ = ["check", "collect", "find_launch_file", "inputs_from", "make_plan", "plan_of_node"]


def make_plan(path: str, inputs: Inputs) -> Plan:
    """Return the plan of a launch file. Raises `DescriptionError` with all problems where there are errors."""
    problems = Problems()
    plan = collect(path, inputs, problems)
    if plan is None or problems.errors:
        raise DescriptionError(problems.ordered)
    return plan


def check(path: str, inputs: Inputs) -> tuple[Problem, ...]:
    """Return everything that is wrong with a launch file."""
    problems = Problems()
    collect(path, inputs, problems)
    return problems.ordered


def plan_of_node(
    package: str, executable: str, arguments: Sequence[str], inputs: Inputs, *, prefix: str = ""
) -> Plan:
    """Return the plan of one node whose arguments are passed on unchanged. Raises `DescriptionError`."""
    problems = Problems()
    packages = InstalledPackages(inputs.environment)
    plan = build(single_node(package, executable, arguments, prefix, problems, packages), problems)
    if problems.errors:
        raise DescriptionError(problems.ordered)
    return plan


def find_launch_file(words: Sequence[str]) -> tuple[str, tuple[str, ...]]:
    """Return the launch file that the first words name, and the words after it. Raises `UsageError`."""
    return launch_files.find_launch_file(words, InstalledPackages(os.environ))


def collect(path: str, inputs: Inputs, problems: Problems, *, load: LoadFile = load) -> Plan | None:
    """Return the plan of a launch file as far as it goes, with everything that is wrong in `problems`.

    `load` reads the files. None where the file itself cannot be read as a launch file.
    """
    with _collector_paused():
        description = load(path, problems, ())
        if description is None:
            return None
        packages = InstalledPackages(inputs.environment)
        resolved = resolve(
            description, inputs, problems, load=load, packages=packages, run_command=run_command
        )
        return build(resolved, problems)


@contextmanager
def _collector_paused() -> Iterator[None]:
    """Keep the garbage collector from walking the trees as they grow, which takes almost half of the time."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()
