"""Descriptions that a test makes as Python launch files do, without a file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.description.launch import Description
from orchestra.description.text import Constant, Template, Words
from orchestra.errors import Problems
from orchestra.location import point
from orchestra.plan.build import build
from orchestra.resolve.commands import run_command
from orchestra.resolve.inputs import Inputs
from orchestra.resolve.packages import InstalledPackages
from orchestra.resolve.resolve import resolve

if TYPE_CHECKING:
    from orchestra.description.entity import Action
    from orchestra.plan.model import Plan
    from orchestra.values import ParameterValue

AT = point("made.launch.py")


def text(written: str) -> Template:
    """Return a text without substitutions."""
    return Template((Words(written, AT),), written, AT)


def value(given: ParameterValue) -> Constant:
    """Return a value that has its type."""
    return Constant(given, AT)


def planned(*actions: Action) -> tuple[Plan, Problems]:
    """Return the plan of some actions, and what is wrong with them."""
    problems, environment = Problems(), {"A": "x"}
    description = Description("/made.launch.py", "made.launch.py", actions)
    resolved = resolve(
        description,
        Inputs(environment),
        problems,
        load=lambda *_: None,
        packages=InstalledPackages(environment),
        run_command=run_command,
    )
    return build(resolved, problems), problems
