"""Plans of launch files in Python, and what is compared of them."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.codec import encode

if TYPE_CHECKING:
    from pathlib import Path

_PLACES = {"location", "provenance"}
_HEAD = """
from launch import *
from launch.actions import *
from launch.conditions import *
from launch.descriptions import Executable
from launch.event_handlers import *
from launch.launch_description_sources import *
from launch.substitutions import *
from launch import events
from launch.events import matches_action
from launch.events.process import *
LC = LaunchConfiguration
"""


@dataclass(frozen=True)
class Planned:
    """A plan without places, and the messages of what is wrong."""

    content: dict[str, Any]
    problems: list[str]

    @property
    def commands(self) -> list[list[str]]:
        """The command lines in order."""
        return [process["command"] for process in self.content["processes"]]

    @property
    def messages(self) -> list[str]:
        """What is logged when the run starts, a timer goes off, or an event comes."""
        return [step["message"] for step in self.steps if "message" in step]

    @property
    def steps(self) -> list[dict[str, Any]]:
        """What all triggers do, in order."""
        return [step for trigger in self.triggers for step in trigger["do"]]

    @property
    def triggers(self) -> list[dict[str, Any]]:
        """The triggers."""
        found: list[dict[str, Any]] = self.content["triggers"]
        return found


def python(folder: Path, actions: str, before: str = "", arguments: tuple[str, ...] = ()) -> Planned:
    """Return the plan of a launch file with these actions; `before` is code of the file."""
    return of(write(folder / "a.launch.py", actions, before), arguments)


def yaml(folder: Path, actions: list[dict[str, Any]], arguments: tuple[str, ...] = ()) -> Planned:
    """Return the plan of the same in YAML."""
    path = folder / "a.launch.yaml"
    path.write_text(json.dumps({"launch": actions}), "utf-8")
    return of(path, arguments)


def write(path: Path, actions: str, before: str = "") -> Path:
    """Write a launch file in Python."""
    body = f"def generate_launch_description():\n    return LaunchDescription([{actions}])\n"
    path.write_text(f"{_HEAD}\n{before}\n{body}", "utf-8")
    return path


def of(path: Path, arguments: tuple[str, ...] = ()) -> Planned:
    """Return the plan of a launch file."""
    problems = Problems()
    environment = {"PATH": "/usr/bin:/bin", "HOME": "/home/robot", "OLD": "old"}
    plan = collect(str(path), inputs_from(list(arguments), environment=environment), problems)
    assert plan is not None, [problem.message for problem in problems.ordered]
    content = _without_places(encode(plan))
    del content["problems"], content["file"]
    return Planned(content, [problem.message for problem in problems.ordered])


def _without_places(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _without_places(item) for key, item in value.items() if key not in _PLACES}
    return [_without_places(item) for item in value] if isinstance(value, list | tuple) else value
