"""The table of contents: a launch file is loaded, resolved and planned; the supervisor then runs the plan."""

from __future__ import annotations

import gc
import os
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING

from orchestra.compat.seam import connected
from orchestra.errors import DescriptionError, Problem, Problems
from orchestra.load.files import load
from orchestra.plan.build import build
from orchestra.resolve import launch_files
from orchestra.resolve.command_line import inputs_from
from orchestra.resolve.commands import run_command
from orchestra.resolve.packages import InstalledPackages
from orchestra.resolve.python.connection import LoadingConnection
from orchestra.resolve.python.isolation import isolated
from orchestra.resolve.resolve import begin, resolve
from orchestra.resolve.single import single_node

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.plan.model import Plan
    from orchestra.resolve.inputs import Inputs
    from orchestra.resolve.resolution import LoadFile, Resolution


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
    packages = InstalledPackages(inputs.environment)
    with _collector_paused(), _loading(path, inputs, load, packages):
        description = load(path, problems, ())
        if description is None:
            return None
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


@contextmanager
def _loading(path: str, inputs: Inputs, load: LoadFile, packages: InstalledPackages) -> Iterator[None]:
    """Let launch files in Python be loaded, and leave this process as it was."""

    def begin_alone(problems: Problems) -> Resolution:
        """Begin a resolution for a context that user code builds for itself."""
        own = replace(inputs, environment=dict(os.environ), arguments=())
        return begin(own, problems, load=load, packages=packages, run_command=run_command)

    words = (f"{item.name}:={item.value}" for item in inputs.arguments)
    connection = LoadingConnection(packages, begin_alone)
    with isolated(inputs.environment, ("ros2", "launch", path, *words)), connected(connection):
        yield
