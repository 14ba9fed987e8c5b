"""Definitions that a node's package needs are found as sources, looked at, built and given to the node."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Problems
from orchestra.fields import replace
from orchestra.pipeline import collect
from orchestra.resolve.command_line import inputs_from

if TYPE_CHECKING:
    from orchestra.plan.model import Plan

_NODE = """
import weather_interfaces
from tf2_msgs.msg import TF2Error
from weather_interfaces.msg import Reading
from weather_interfaces.srv import Put
from rclpy.serialization import deserialize_message, serialize_message

reading = Reading(temperature=21.5)
reading.more.x = 2.0
assert deserialize_message(serialize_message(reading), Reading) == reading
type(Put).__import_type_support__()
print("the temperature is", reading.temperature, TF2Error.TIMEOUT_ERROR)
"""

_FILES = {
    "weather/package.xml": "<package><name>weather</name><depend>weather_interfaces</depend>"
    "<exec_depend>tf2_msgs</exec_depend><exec_depend>rclpy</exec_depend><depend>no_such_key</depend></package>",
    "weather/weather/__init__.py": "",
    "weather/weather/nodes/report.py": _NODE,
    "weather/weather/nodes/other.py": "print('nothing is needed')",
    "group/weather_interfaces/package.xml": "<package><name>weather_interfaces</name></package>",
    "group/weather_interfaces/msg/Reading.msg": "float64 temperature\nbase_interfaces/More more\n",
    "group/weather_interfaces/srv/Put.srv": "Reading reading\n---\nbool ok\n",
    "group/base_interfaces/package.xml": "<package><name>base_interfaces</name></package>",
    "group/base_interfaces/msg/More.msg": "float64 x\n",
    "demo.launch.yaml": "launch:\n  - node: {pkg: weather, exec: report, output: screen}\n",
}


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    source = tmp_path / "ws" / "src"
    for name, text in _FILES.items():
        (source / name).parent.mkdir(parents=True, exist_ok=True)
        (source / name).write_text(text)
    monkeypatch.syspath_prepend(source / "weather")
    monkeypatch.chdir(source)
    return source


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    given = {
        "ORCHESTRA_CACHE": str(tmp_path / "cache"),
        "ORCHESTRA_HOME": str(tmp_path / "home"),
        "ORCHESTRA_COMPILE_INTERFACES": "0",
        "ROS_DOMAIN_ID": "175",
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }
    return {**os.environ, **given}


def _planned(environment: dict[str, str], *, launching: bool = False) -> tuple[Plan | None, Problems]:
    problems = Problems()
    inputs = replace(inputs_from([], environment=environment), launching=launching)
    return collect("demo.launch.yaml", inputs, problems), problems


def test_a_plan_tells_the_prefixes_and_builds_nothing(
    workspace: Path, environment: dict[str, str], tmp_path: Path
) -> None:
    del workspace
    plan, problems = _planned({**environment, "PYTHONPATH": "/before"})
    assert plan is not None
    assert problems.ordered == ()
    (process,) = plan.processes
    path = (process.environment["PYTHONPATH"] or "").split(":")
    names = [Path(entry).parents[2].name.rpartition("-")[0] for entry in path[:-1]]
    assert names == ["base_interfaces", "weather_interfaces", "tf2_msgs"]
    assert path[-1] == "/before"
    assert "AMENT_PREFIX_PATH" in process.environment
    assert process.warm is not None
    assert not process.warm.warm
    assert not list(tmp_path.glob("cache/interfaces/*_interfaces-*"))


def test_a_wrong_definition_is_one_problem_of_the_check(workspace: Path, environment: dict[str, str]) -> None:
    (workspace / "group/base_interfaces/msg/More.msg").write_text("float64 x\nflaot64 y\n")
    for launching in (False, True):
        _, problems = _planned(environment, launching=launching)
        (problem,) = problems.ordered
        assert problem.span is not None
        assert (problem.code, problem.span.line, problem.span.column) == ("ORC150", 2, 1)
        assert problem.span.file == "group/base_interfaces/msg/More.msg"


def test_a_package_without_a_manifest_needs_nothing(workspace: Path, environment: dict[str, str]) -> None:
    (workspace / "weather/package.xml").unlink()
    plan, problems = _planned(environment)
    assert plan is not None
    assert (plan.processes[0].environment, problems.ordered) == ({}, ())


def test_a_launch_builds_what_is_needed_and_the_node_runs(
    workspace: Path, environment: dict[str, str], tmp_path: Path
) -> None:
    called = {**environment, "PYTHONPATH": str(workspace / "weather")}
    command = [sys.executable, "-W", "ignore", "-m", "orchestra", "launch", "demo.launch.yaml"]
    for more, prefixes in (("", 3), ("float64 y\n", 5)):  # those of tf2_msgs stay as they are
        (workspace / "group/base_interfaces/msg/More.msg").write_text(f"float64 x\n{more}")
        done = subprocess.run(
            command, cwd=workspace, env=called, capture_output=True, text=True, check=False, timeout=110
        )
        assert "the temperature is 21.5 5" in done.stdout + done.stderr
        assert done.returncode == 0, done.stderr
        assert len(list(tmp_path.glob("cache/interfaces/[a-z]*-*"))) == prefixes
