"""Compat objects as launch files use them: while files are loaded, and with contexts that have a state of their own."""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING

from orchestra.compat.seam import connected
from orchestra.load.files import load
from orchestra.resolve.commands import run_command
from orchestra.resolve.inputs import Inputs
from orchestra.resolve.packages import InstalledPackages
from orchestra.resolve.python.connection import LoadingConnection
from orchestra.resolve.python.isolation import isolated
from orchestra.resolve.resolve import begin

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from orchestra.errors import Problems
    from orchestra.resolve.resolution import Resolution


@contextmanager
def loading(environment: Mapping[str, str]) -> Iterator[None]:
    """Let launch files be loaded, in an environment."""
    inputs = Inputs(dict(environment))
    packages = InstalledPackages(environment)

    def begin_alone(problems: Problems) -> Resolution:
        own = replace(inputs, environment=dict(environment))
        return begin(own, problems, load=load, packages=packages, run_command=run_command)

    with isolated(environment, ("ros2",)), connected(LoadingConnection(packages, begin_alone)):
        yield
