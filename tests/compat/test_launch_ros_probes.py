"""Nodes written in Python come to the command lines and parameters that upstream was recorded to make of them."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest

from tests.compat.python_plans import of_python
from tests.plan.test_node_probes import _records, _split

if TYPE_CHECKING:
    from pathlib import Path

# Upstream differs here on purpose.
_ACCEPTED = {"[],{'name':'/n1'}": "the slash before a node's name is taken away"}


@pytest.mark.conforms(
    "4.5 order",
    "4.5 --ros-args",
    "4.5 arguments and ROS arguments",
    "4.6.1 str",
    "4.6.3 content",
    "D18",
    "D49",
    "1.12.1 name",
)
@pytest.mark.parametrize("record", _records(), ids=lambda record: record["in"])
def test_a_node_is_started_as_by_upstream(record: dict[str, Any], tmp_path: Path) -> None:
    body = f"""
        before, keywords = {record["in"]}
        return LaunchDescription([*before, Node(executable='exe', **keywords)])
    """
    program = tmp_path / "exe"
    program.touch(mode=0o755)
    found = of_python(tmp_path, body, {"PATH": f"{tmp_path}:/usr/bin:/bin"})
    errors = [problem for problem in found.problems if problem.severity.value == "error"]
    if "err" in record and record["in"] not in _ACCEPTED:
        assert len(errors) == 1
        return
    assert errors == []
    process = found.process
    if record["in"] in _ACCEPTED:
        assert process["name"] == "n1"
        return
    words, parameters = _split(record["out"])
    ours = iter(process["command"])
    assert [word for word in ours if word != "--params-file" or not next(ours)] == words
    assert json.loads(json.dumps(process["parameters"])) == parameters
    assert _types(process["parameters"]) == _types(parameters)


def _types(parameters: dict[str, Any]) -> dict[str, Any]:
    return {
        name: [type(item) for item in value] if isinstance(value, list | tuple) else type(value)
        for name, value in parameters.items()
    }
