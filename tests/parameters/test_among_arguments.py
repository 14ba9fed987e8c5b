"""Parameters among a node's own arguments count as rcl has them: the plan says what a running node has."""

from __future__ import annotations

import os
from contextlib import chdir
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.errors import Code, Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.parameter_file import contents
from tests.parameters.test_arrival import _arrived

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from orchestra.plan.model import Process

_FILE = """\
/**: {ros__parameters: {a: from file, nested: {b: [1, 2]}}}
/ns/n: {ros__parameters: {c: 1.5}}
/other: {ros__parameters: {d: true}}
"""
_CASES = {
    "single": "ros_args: -p a:=5 --param nested.b:=1.0",
    "behind --ros-args": "args: '-p no:=1 --ros-args -p a:=yes -p b:=[1.0,2.0] -- -p no:=2'",
    "for a node of a name": "ros_args: '-p n:a:=1 -p other:a:=2'",
    "below what the description says": "ros_args: '-p a:=1 -p e:=2', param: [{name: a, value: 3}]",
    "before what is set for all": "ros_args: '-p all:=1', param: [{from: given.yaml}]",
    "a file": "ros_args: --params-file $(dirname)/given.yaml -p c:=2.5",
    "a file, and parameters of its own": "args: --ros-args --params-file $(dirname)/given.yaml, param: [{name: a, value: x}]",
    "an integer beats a text of one pattern": "ros_args: -p a:=1, param: [{from: given.yaml}]",
}


def _planned(folder: Path, node: str) -> tuple[Process, Problems]:
    (folder / "given.yaml").write_text(_FILE)
    (folder / "a.yaml").write_text(
        "launch:\n  - set_parameter: {name: all, value: 9}\n"
        f"  - node: {{exec: e, name: n, namespace: /ns, {node}}}\n"
    )
    problems = Problems()
    with chdir(folder):
        plan = collect(str(folder / "a.yaml"), inputs_from((), environment=os.environ), problems)
    assert plan is not None
    return plan.processes[0], problems


@pytest.mark.parametrize("node", _CASES.values(), ids=_CASES)
def test_the_plan_has_what_the_node_has(ask_rcl: Callable[..., Any], tmp_path: Path, node: str) -> None:
    process, problems = _planned(tmp_path, node)
    assert not problems.errors, list(problems)
    given = _arrived(ask_rcl, process)
    assert {name: repr(value) for name, value in process.parameters.items()} == {
        name: repr(tuple(value) if isinstance(value, list) else value) for name, value in given.items()
    }


def test_what_is_on_the_command_line_already_is_not_given_in_a_file(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text("launch:\n  - node: {exec: e, name: n, ros_args: -p a:=5}\n")
    plan = collect(str(tmp_path / "a.yaml"), inputs_from((), environment=os.environ), Problems())
    assert plan is not None
    (process,) = plan.processes
    assert process.parameters == {"a": 5}
    assert process.command == ("e", "--ros-args", "-p", "a:=5", "--ros-args", "-r", "__node:=n")
    assert contents(process) == {}


def test_what_rcl_refuses_is_told(tmp_path: Path) -> None:
    _, problems = _planned(tmp_path, "ros_args: '-p a:=[1,x] -p b:='")
    assert [(item.code, item.span and item.span.column) for item in problems.errors] == [
        (Code.BAD_VALUE, 60),
        (Code.BAD_VALUE, 72),
    ]


def test_a_schema_looks_at_them(tmp_path: Path) -> None:
    schema = "{type: object, required: [a], properties: {a: {type: number, x-ros-type: double}}, additionalProperties: false}"
    (tmp_path / "s.yaml").write_text(schema)
    (tmp_path / "more.yaml").write_text("/**: {ros__parameters: {a: 1.0}}\n")
    wrong = "params_schema: s.yaml, ros_args: '-p a:=5 -p b:=1'"
    _, problems = _planned(tmp_path, wrong.replace("b:=1", "all:=1"))
    told = [(item.code, item.suggestion) for item in problems.errors]
    assert (Code.DECLARED_TYPE, "5.0") in told
    for right in ("-p a:=5.0", "--params-file more.yaml", "--params-file /not/here.yaml"):
        _, problems = _planned(tmp_path, f"params_schema: s.yaml, ros_args: {right}")
        assert Code.REQUIRED_PARAMETER not in [item.code for item in problems]
    _, problems = _planned(tmp_path, "params_schema: s.yaml")
    assert Code.REQUIRED_PARAMETER in [item.code for item in problems]
