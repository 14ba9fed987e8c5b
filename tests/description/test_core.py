"""The models are read by pydantic's core alone, which whoever imports pydantic later has too."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

_YAML = """
launch:
  - arg: {name: size, default: "1", choices: ["1", "2"]}
  - let: {name: other, value: $(var size)}
  - include: {file: inner.launch.yaml, arg: [{name: a, value: b}]}
  - group:
      children:
        - push_ros_namespace: {namespace: below}
        - node:
            pkg: demo
            exec: program
            param: [{name: a, value: 1}, {name: b, param: [{name: c, value: [x, y]}]}, {from: given.yaml}]
            remap: [{from: a, to: b}]
            ready: {log: ready}
  - executable: {cmd: "true", name: first, env: [{name: A, value: b}], restart: on-failure}
  - timer: {period: 1.0, children: [{log: {message: later}}]}
"""
_XML = """
<launch>
  <arg name="size" default="1"><choice value="1"/><choice value="2"/></arg>
  <let name="other" value="$(var size)"/>
  <include file="inner.launch.yaml"><arg name="a" value="b"/></include>
  <group>
    <push_ros_namespace namespace="below"/>
    <node pkg="demo" exec="program">
      <param name="a" value="1"/><param name="b"><param name="c" value="x"/></param><param from="given.yaml"/>
      <remap from="a" to="b"/>
      <ready log="ready"/>
    </node>
  </group>
  <executable cmd="true" name="first" restart="on-failure"><env name="A" value="b"/></executable>
  <timer period="1.0"><log message="later"/></timer>
</launch>
"""
_FILES = {
    "inner.launch.yaml": "launch:\n  - arg: {name: a}\n",
    "given.yaml": "/**:\n  ros__parameters: {given: 1}\n",
    "one.launch.yaml": _YAML,
    "one.launch.xml": _XML,
    "one.launch.py": """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("size", default_value="1"),
        Node(package="demo", executable="program", parameters=[{"a": 1}], remappings=[("a", "b")]),
        ExecuteProcess(cmd=["true"], name="first"),
    ])
""",
}
_PLAN = """
import json, runpy, sys
sys.argv[1:] = ["plan", {name!r}, "--format", "json"]
try:
    runpy.run_module("orchestra", run_name="__main__")
except SystemExit as end:
    sys.stderr.write(json.dumps([end.code, sorted(sys.modules)]))
"""
_LAUNCH = """
import sys
from pathlib import Path
import orchestra.__main__ as start

class Telling:
    '''Tells what the resolver has imported before it hands the plan over.'''
    def __init__(self, stream):
        self.stream = stream
    def write(self, plan):
        Path("modules").write_text(" ".join(sys.modules))
        return self.stream.write(plan)
    def __getattr__(self, name):
        return getattr(self.stream, name)

resolve = start._resolve
start._resolve = lambda words, stream: resolve(words, Telling(stream))
sys.argv[1:] = ["launch", "one.launch.yaml"]
sys.exit(start.main())
"""
_LATER = """
from orchestra.description.core import PydanticCustomError, ValidationError
from orchestra.description.actions.let import Let
{between}
import pydantic
import pydantic_core
from pydantic_core import _pydantic_core
class Model(pydantic.BaseModel):
    x: int
    @pydantic.field_validator("x")
    def odd(cls, value):
        if value % 2 == 0:
            raise PydanticCustomError("even", "it is even")
        return value
assert pydantic.ValidationError is ValidationError is _pydantic_core.ValidationError
assert Model(x="3").x == 3
try:
    Model(x=2)
except ValidationError as error:
    assert error.errors()[0]["msg"] == "it is even"
try:
    Let.model_validate({{}})
except pydantic.ValidationError as error:
    assert [item["loc"] for item in error.errors()] == [("name",), ("value",)]
    print("both")
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name, text in _FILES.items():
        (tmp_path / name).write_text(text)
    return tmp_path


@pytest.mark.parametrize("name", [name for name in _FILES if name.startswith("one")])
def test_a_plan_is_made_without_pydantic(folder: Path, name: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", _PLAN.format(name=name)],
        cwd=folder,
        env={**os.environ, "_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1"},
        capture_output=True,
        text=True,
        check=True,
        timeout=100,
    )
    status, modules = json.loads(done.stderr.splitlines()[-1])
    assert (status, "first" in done.stdout) == (0, True), done.stderr
    assert "pydantic_core._pydantic_core" in modules
    assert not {"pydantic", "pydantic_core", "typing_extensions", "asyncio"} & set(modules)


def test_a_first_launch_resolves_without_pydantic(tmp_path: Path) -> None:
    (tmp_path / "one.launch.yaml").write_text("launch:\n  - executable: {cmd: 'true', name: first}\n")
    subprocess.run(
        [sys.executable, "-c", _LAUNCH],
        cwd=tmp_path,
        env={
            **os.environ,
            "ORCHESTRA_HOME": str(tmp_path / "home"),
            "ORCHESTRA_CACHE": str(tmp_path / "cache"),
            "XDG_RUNTIME_DIR": str(tmp_path),
            "_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1",
        },
        capture_output=True,
        check=True,
        timeout=100,
    )
    modules = set((tmp_path / "modules").read_text().split())
    assert {"orchestra.description.actions.executable", "pydantic_core._pydantic_core"} <= modules
    assert not {"pydantic", "pydantic_core", "typing_extensions", "asyncio"} & modules


@pytest.mark.parametrize("between", ["", "Let.model_fields", "import pydantic.main"])
def test_whoever_imports_pydantic_later_has_the_same_core(between: str) -> None:
    code = _LATER.format(between=between)
    assert subprocess.check_output([sys.executable, "-c", code], text=True, timeout=100) == "both\n"


def test_the_core_of_pydantic_that_is_there_already_is_taken() -> None:
    code = f"import pydantic\n{_LATER.format(between='')}"
    assert subprocess.check_output([sys.executable, "-c", code], text=True, timeout=100) == "both\n"
