"""Plans of launch files in Python, without places, beside those of the same description in YAML."""

from __future__ import annotations

import json
from dataclasses import dataclass
from textwrap import dedent, indent
from typing import TYPE_CHECKING, Any

from orchestra.errors import Problem, Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.codec import encode
from tests.load.planning import _without_places

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

_IMPORTS = """\
from typing import List

from launch import LaunchContext, LaunchDescription
from launch.actions import *
from launch.conditions import IfCondition, UnlessCondition
from launch.events import matches_action
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.descriptions import *
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events import matches_node_name
from launch_ros.events.lifecycle import ChangeState
from launch_ros.substitutions import ExecutableInPackage, FindPackagePrefix, FindPackageShare

LC = LaunchConfiguration


def generate_launch_description():
"""
_ENVIRONMENT = {"PATH": "/usr/bin:/bin"}


@dataclass(frozen=True)
class Planned:
    """A plan as data without places, and its problems."""

    content: dict[str, Any]
    problems: tuple[Problem, ...]

    @property
    def messages(self) -> list[str]:
        """What is wrong, warnings included."""
        return [problem.message for problem in self.problems]

    @property
    def process(self) -> dict[str, Any]:
        """The only process."""
        (found,) = self.content["processes"]
        assert isinstance(found, dict)
        return found


def of_python(folder: Path, body: str, environment: Mapping[str, str] = _ENVIRONMENT) -> Planned:
    """Return the plan of a file whose `generate_launch_description` has this body, or returns this list."""
    body = dedent(body).strip()
    if body.startswith("["):
        body = f"return LaunchDescription({body})"
    path = folder / "a.launch.py"
    path.write_text(_IMPORTS + indent(body, "    ") + "\n", "utf-8")
    return _planned(path, environment)


def of_yaml(folder: Path, actions: Any, environment: Mapping[str, str] = _ENVIRONMENT) -> Planned:
    """Return the plan of a file with these actions."""
    path = folder / "a.launch.yaml"
    path.write_text(json.dumps({"launch": actions}), "utf-8")
    return _planned(path, environment)


def _planned(path: Path, environment: Mapping[str, str]) -> Planned:
    problems = Problems()
    plan = collect(str(path), inputs_from([], environment=dict(environment)), problems)
    content = _without_places(encode(plan)) if plan is not None else {}
    for key in ("problems", "file", "description"):
        content.pop(key, None)
    return Planned(content, problems.ordered)
