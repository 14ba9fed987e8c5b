"""Nodes come to the command lines and parameters that upstream was recorded to make of them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import yaml

from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from

_PROBES = Path(__file__).parents[1] / "data" / "launch-probes.jsonl"

# Upstream differs here on purpose.
_ACCEPTED = {"[],{'name':'/n1'}": "the slash before a node's name is taken away"}


class _Configuration(str):
    """`LaunchConfiguration`, as it is written in YAML."""

    __slots__ = ()


class _Typed:
    """`ParameterValue`."""

    def __init__(self, value: str, value_type: type) -> None:
        self.value, self.type = value, value_type.__name__


_WORDS: dict[str, Any] = {
    "float": float,
    "str": str,
    "LaunchConfiguration": lambda name: _Configuration(f"$(var {name})"),
    "ParameterValue": _Typed,
    "PushROSNamespace": lambda namespace: {"push_ros_namespace": {"namespace": namespace}},
    "SetLaunchConfiguration": lambda name, value: {"let": {"name": name, "value": value}},
    "SetParameter": lambda name, value: {"set_parameter": {"name": name, "value": value}},
    "SetRemap": lambda source, target: {"set_remap": {"from": source, "to": target}},
}


def _records() -> list[dict[str, Any]]:
    lines = _PROBES.read_text("utf-8").splitlines()
    return [record for record in map(json.loads, lines) if record["k"] == "node"]


def _description(text: str) -> str:
    """Return the launch file that says what the Python text of a record says."""
    before, keywords = eval(text, {"__builtins__": {}, "True": True, "False": False, "None": None}, _WORDS)  # noqa: S307 - our own records
    node = {"exec": "exe", **{key: keywords[key] for key in ("name", "namespace") if key in keywords}}
    if "arguments" in keywords:
        node["args"] = " ".join(keywords["arguments"])
    if "ros_arguments" in keywords:
        node["ros_args"] = " ".join(keywords["ros_arguments"])
    node["remap"] = [{"from": source, "to": target} for source, target in keywords.get("remappings", ())]
    node["param"] = [item for source in keywords.get("parameters", ()) for item in _parameters(source)]
    return json.dumps({"launch": [*before, {"node": node}]})


def _parameters(source: Any) -> list[dict[str, Any]]:
    if isinstance(source, str):
        return [{"from": source}]
    return [_parameter(name, value) for name, value in source.items()]


def _parameter(name: str, value: Any) -> dict[str, Any]:
    match value:
        case dict():
            return {"name": name, "param": _parameters(value)}
        case _Typed():
            return {"name": name, "value": value.value, "type": value.type}
        case [str(), _Configuration()]:
            return {"name": name, "value": "".join(value)}
        case list() if value and isinstance(value[0], list):
            return {"name": name, "value": [item for (item,) in value]}
    return {"name": name, "value": value}


def _split(argv: list[Any]) -> tuple[list[str], dict[str, Any]]:
    """Return the words without those of parameters, and the parameters, later ones over earlier ones."""
    words: list[str] = []
    parameters: dict[str, Any] = {}
    rest = iter(argv)
    for word in rest:
        if word == "-p":
            name, _, value = next(rest).partition(":=")
            parameters[name] = yaml.safe_load(value)
        elif word == "--params-file":
            ((_, section),) = next(rest)["file"].items()
            parameters |= section["ros__parameters"]
        else:
            words.append(word)
    return words, parameters


_PYTHON = """from launch import LaunchDescription
from launch.actions import SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node, PushROSNamespace, SetParameter, SetRemap
from launch_ros.descriptions import ParameterValue


def generate_launch_description():
    before, keywords = {}
    return LaunchDescription([*before, Node(executable='exe', **keywords)])
"""


@pytest.mark.conforms("4.5 order", "4.5 --ros-args", "4.6.1 substitutions", "4.6.3 content", "4.6.3 top key")
@pytest.mark.parametrize("language", ["yaml", "py"])
@pytest.mark.parametrize("record", _records(), ids=lambda record: record["in"])
def test_a_node_is_started_as_by_upstream(record: dict[str, Any], language: str, tmp_path: Path) -> None:
    written = record["in"]
    text = _description(written) if language == "yaml" else _PYTHON.replace("{}", written, 1)
    file = tmp_path / f"main.launch.{language}"
    file.write_text(text, "utf-8")
    problems = Problems()
    plan = collect(str(file), inputs_from([], environment={}), problems)
    if "err" in record and record["in"] not in _ACCEPTED:
        assert len(problems.errors) == 1
        return
    assert list(problems.errors) == []
    assert plan is not None
    (process,) = plan.processes
    if "out" in record:
        words, parameters = _split(record["out"])
        ours = iter(process.command)
        assert [word for word in ours if word != "--params-file" or not next(ours)] == words
        assert json.loads(json.dumps(process.parameters)) == parameters
        assert {
            name: type(value) for name, value in process.parameters.items() if not isinstance(value, tuple)
        } == {name: type(value) for name, value in parameters.items() if not isinstance(value, list)}
