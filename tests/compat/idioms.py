"""Launch files as people write them, in a workspace with packages, and what is told of their plans."""

from __future__ import annotations

from dataclasses import dataclass
from textwrap import dedent
from typing import TYPE_CHECKING, Any

from orchestra.errors import Problem, Problems, Severity
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.codec import encode

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

_HEAD = """\
import os
import sys
from pathlib import Path
import launch
import launch_ros
from ament_index_python.packages import get_package_share_directory
from launch import LaunchContext, LaunchDescription, Substitution
from launch.actions import *
from launch.conditions import IfCondition, UnlessCondition
from launch.event_handlers import *
from launch.launch_description_sources import *
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.descriptions import ComposableNode, ParameterFile, ParameterValue
from launch_ros.substitutions import ExecutableInPackage, FindPackagePrefix, FindPackageShare

LC = LaunchConfiguration
"""


@dataclass(frozen=True)
class Planned:
    """A plan as data, and its problems."""

    content: dict[str, Any]
    problems: tuple[Problem, ...]

    @property
    def errors(self) -> list[str]:
        """What is wrong."""
        return [problem.message for problem in self.problems if problem.severity is Severity.ERROR]

    @property
    def warnings(self) -> list[str]:
        """What is told beside."""
        return [problem.message for problem in self.problems if problem.severity is Severity.WARNING]

    @property
    def commands(self) -> list[str]:
        """The command lines; programs of packages by their names alone."""
        return [" ".join([_name(line[0]), *line[1:]]) for line in self._each("command")]

    @property
    def parameters(self) -> list[dict[str, Any]]:
        """The parameters of each process."""
        return self._each("parameters")

    def _each(self, field: str) -> list[Any]:
        return [process[field] for process in self.content["processes"]]


def planned(
    folder: Path,
    code: str,
    *words: str,
    files: Mapping[str, str] | None = None,
    modules: Mapping[str, str] | None = None,
) -> Planned:
    """Return the plan of a launch file in Python: a list of actions, the body of its function, or all its code.

    `files` are beside it; `modules` are Python packages of the workspace, which has the package `demo`.
    """
    prefix = folder / "install"
    _package(prefix, "demo", ("talker", "listener"))
    for name, text in (files or {}).items():
        _write(folder / name, text)
    for name, text in (modules or {}).items():
        _write(prefix / "lib" / "python3.11" / "site-packages" / name, text)
    path = folder / "a.launch.py"
    _write(path, _HEAD + _whole(dedent(code).strip()))
    environment = {"PATH": "/usr/bin:/bin", "HOME": "/home/me", "AMENT_PREFIX_PATH": str(prefix)}
    problems = Problems()
    plan = collect(str(path), inputs_from(list(words), environment=environment), problems)
    content = {"processes": [], "triggers": []} if plan is None else encode(plan)
    return Planned(content, problems.ordered)


def _whole(code: str) -> str:
    if "def generate_launch_description" in code:
        return code + "\n"
    body = f"return LaunchDescription({code})" if code.startswith("[") else code
    return "def generate_launch_description():\n" + "".join(f"    {line}\n" for line in body.split("\n"))


def _package(prefix: Path, name: str, executables: tuple[str, ...]) -> None:
    _write(prefix / "share" / "ament_index" / "resource_index" / "packages" / name, "")
    (prefix / "share" / name).mkdir(parents=True, exist_ok=True)
    for executable in executables:
        _write(prefix / "lib" / name / executable, "#!/bin/sh\n").chmod(0o755)


def _write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(dedent(text), "utf-8")
    return path


def _name(program: str) -> str:
    return program.rpartition("/")[2]
