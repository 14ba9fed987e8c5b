"""Where a parameter that its node would refuse is told: at the value, the item or the name as it is written."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.declared.checking import checked, marked, told

if TYPE_CHECKING:
    from pathlib import Path

_SCHEMA = """
driver:
  rate: {type: double, default_value: 10.0, validation: {bounds<>: [1.0, 100.0]}}
  mode: {type: string, default_value: fast, validation: {one_of<>: [[fast, slow]]}}
  joints: {type: string_array, default_value: [], validation: {subset_of<>: [[left, right]]}}
  limits:
    max: {type: int, default_value: 3}
"""
_YAML = """\
launch:
  - node:
      exec: sleep
      name: driver
      params_schema: driver.gpl.yaml
      param:
        - {PARAM}
"""
_XML = """\
<launch>
  <node exec="sleep" name="driver" params_schema="$(dirname)/driver.gpl.yaml">
    {PARAM}
  </node>
</launch>
"""
_PYTHON = """\
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([
        Node(executable="sleep", name="driver", params_schema="driver.gpl.yaml",
             parameters=[{PARAM}]),
    ])
"""
_INCLUDED = "launch:\n  - include: {file: inner.launch.yaml}\n"
_FILE = "/driver:\n  ros__parameters:\n    {PARAM}\n"

# What is written for the parameters, in which language, code, what is marked, what is suggested.
ROWS = [
    ("yaml", "{name: rate, value: 20}", "ORC092", "20", "20.0"),
    ("yaml", "{name: rate, value: 200.0}", "ORC093", "200.0", None),
    ("yaml", "{name: mode, value: fsat}", "ORC093", "fsat", "fast"),
    ("yaml", "{name: rats, value: 2.0}", "ORC091", "rats", "rate"),
    ("yaml", "{name: joints, value: [left, rihgt]}", "ORC093", "rihgt", "right"),
    ("yaml", "{name: limits, param: [{name: mx, value: 2}]}", "ORC091", "mx", "max"),
    ("yaml", "{name: limts, param: [{name: max, value: 2}]}", "ORC091", "limts", "limits"),
    ("yaml", "{name: limits.mx, value: 2}", "ORC091", "limits.mx", "limits.max"),
    ("yaml", "{name: limits.max, value: $(eval '1 + 0.5')}", "ORC092", "$(eval '1 + 0.5')", None),
    ("xml", '<param name="rate" value="20"/>', "ORC092", "20", "20.0"),
    ("xml", '<param name="rats" value="2.0"/>', "ORC091", "rats", "rate"),
    ("xml", '<param name="limits"><param name="mx" value="2"/></param>', "ORC091", "mx", "max"),
    ("xml", '<param name="mode" value="fsat"/>', "ORC093", "fsat", "fast"),
    ("file", "rate: 20", "ORC092", "20", "20.0"),
    ("file", "rate: 1.0e+3", "ORC093", "1.0e+3", None),
    ("file", "rats: 2.0", "ORC091", "rats", "rate"),
    ("file", "joints: [left, rihgt]", "ORC093", "rihgt", "right"),
    ("file", "joints: left", "ORC092", "left", '["left"]'),
    ("file", "mode: 'fsat'", "ORC093", "'fsat'", "fast"),
    ("file", "mode: slw", "ORC093", "slw", "slow"),
    ("file", "limts: {max: 2, min: 1}", "ORC091", "limts", "limits"),
    ("file", "limits: {mx: 2}", "ORC091", "mx", "max"),
    ("file", "limits.mx: 2", "ORC091", "limits.mx", "limits.max"),
    ("file", "max: 2", "ORC091", "max", "limits.max"),
]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row[0]}-{row[1]}")
@pytest.mark.parametrize("included", [False, True])
def test_the_place_is_what_is_wrong(
    tmp_path: Path, row: tuple[str, str, str, str, str | None], included: bool
) -> None:
    language, param, code, mark, suggestion = row
    files = {"driver.gpl.yaml": _SCHEMA}
    if language == "xml":
        files["inner.launch.xml"] = _XML.replace("{PARAM}", param)
    elif language == "file":
        files["inner.launch.yaml"] = _YAML.replace("{PARAM}", "{from: p.yaml}")
        files["p.yaml"] = _FILE.replace("{PARAM}", param)
    else:
        files["inner.launch.yaml"] = _YAML.replace("{PARAM}", param)
    inner = next(name for name in files if name.startswith("inner"))
    outer = {"outer.launch.yaml": _INCLUDED.replace("inner.launch.yaml", inner)} if included else {}
    problems = checked(tmp_path, {**outer, inner: files[inner], **files})
    assert [problem.code for problem in problems] == [code], told(problems)
    (problem,) = problems
    assert (marked(problem, tmp_path), problem.suggestion) == (mark, suggestion)
    assert len(problem.included_from) == included + (language == "file")


@pytest.mark.parametrize(
    ("param", "code"),
    [("{'rate': 20}", "ORC092"), ("{'rats': 2.0}", "ORC091"), ("{'mode': 'fsat'}", "ORC093")],
)
def test_python_is_checked_too(tmp_path: Path, param: str, code: str) -> None:
    files = {"a.launch.py": _PYTHON.replace("{PARAM}", param), "driver.gpl.yaml": _SCHEMA}
    (problem,) = checked(tmp_path, files)
    assert problem.code == code
    assert problem.span is not None
    assert problem.span.file == "a.launch.py"
    assert problem.span.line in (6, 7)


def test_what_the_command_line_gives_is_checked(tmp_path: Path) -> None:
    files = {"a.launch.yaml": _YAML.replace("- {PARAM}", "[]"), "driver.gpl.yaml": _SCHEMA}
    assert checked(tmp_path, files) == ()
    (problem,) = checked(tmp_path, files, "/driver:rate:=200.0")
    assert problem.code == "ORC093"
    (problem,) = checked(tmp_path, files, "/driver:rats:=20.0")
    assert (problem.code, problem.suggestion, problem.notes) == ("ORC091", None, ("did you mean 'rate'?",))


@pytest.mark.parametrize("line", ["{name: gains, value: [1, 2]}", "{name: gains, value: [ 1,2 ] }"])
def test_a_list_on_one_line_is_told_as_a_whole(tmp_path: Path, line: str) -> None:
    schema = "driver: {gains: {type: double_array}}"
    (problem,) = checked(
        tmp_path, {"a.launch.yaml": _YAML.replace("{PARAM}", line), "driver.gpl.yaml": schema}
    )
    assert (problem.code, problem.suggestion, problem.notes) == ("ORC092", "[1.0, 2.0]", ())
    assert marked(problem, tmp_path) == line.partition("value: ")[2].rstrip("} ")


def test_a_list_that_stands_in_items_is_suggested_in_a_note(tmp_path: Path) -> None:
    line, schema = (
        "name: gains\n          value:\n            - 1\n            - 2",
        "driver: {gains: {type: double_array}}",
    )
    (problem,) = checked(
        tmp_path, {"a.launch.yaml": _YAML.replace("{PARAM}", line), "driver.gpl.yaml": schema}
    )
    told = (problem.suggestion, marked(problem, tmp_path), problem.notes)
    assert told == (None, "1", ("did you mean '[1.0, 2.0]'?",))


def test_a_value_that_does_not_count_is_not_told(tmp_path: Path) -> None:
    written = _YAML.replace("- {PARAM}", "- {name: rate, value: 200.0}\n        - {name: rate, value: 20.0}")
    problems = checked(tmp_path, {"a.launch.yaml": written, "driver.gpl.yaml": _SCHEMA})
    assert [problem.code for problem in problems if problem.code.startswith("ORC09")] == []


def test_one_mistake_in_a_file_of_two_robots_is_one_problem(tmp_path: Path) -> None:
    inner = _YAML.replace("{PARAM}", "{from: p.yaml}").replace(
        "name: driver\n", "name: driver\n      namespace: $(var robot)\n"
    )
    files = {
        "a.launch.yaml": "launch:\n  - include:\n      file: inner.yaml\n      for_each: {robot: [r1, r2]}\n",
        "inner.yaml": inner,
        "p.yaml": "/**:\n  ros__parameters:\n    rate: 200.0\n",
        "driver.gpl.yaml": _SCHEMA,
    }
    assert [problem.code for problem in checked(tmp_path, files)] == ["ORC093"]


def test_a_schema_that_is_not_there_is_told_where_it_is_named(tmp_path: Path) -> None:
    written = _YAML.replace("{PARAM}", "{name: rate, value: 2.0}")
    (problem,) = checked(tmp_path, {"a.launch.yaml": written, "driver.gpl.yml": _SCHEMA})
    assert (problem.code, marked(problem, tmp_path), problem.suggestion) == (
        "ORC029",
        "driver.gpl.yaml",
        "driver.gpl.yml",
    )


def test_what_is_missing_is_told_at_the_node_and_only_where_all_is_known(tmp_path: Path) -> None:
    schema = "driver: {port: {type: string}, baud: {type: int}}"
    written = _YAML.replace("{PARAM}", "{name: baud, value: 9600}")
    problems = checked(tmp_path, {"a.launch.yaml": written, "driver.gpl.yaml": schema})
    assert told(problems) == [
        "ORC094 a.launch.yaml:2:5 error the node needs a value for its parameter 'port', which has no default"
    ]
    unknown = _YAML.replace("{PARAM}", "{from: /etc/driver-of-test/ports.yaml}")
    assert not checked(tmp_path, {"a.launch.yaml": unknown, "driver.gpl.yaml": schema})


_MODEL = """
from pydantic import BaseModel, Field

class Params(BaseModel):
    rate: float = Field(10.0, ge=1, le=100)
"""


@pytest.mark.parametrize("name", ["models:Params", "models.Params", "pack.models:Params"])
def test_a_model_beside_the_launch_file(tmp_path: Path, name: str) -> None:
    written = _YAML.replace("{PARAM}", "{name: rate, value: 200.0}").replace("driver.gpl.yaml", name)
    files = {"a.launch.yaml": written, "models.py": _MODEL, "pack/__init__.py": "", "pack/models.py": _MODEL}
    (problem,) = checked(tmp_path, files)
    assert (problem.code, marked(problem, tmp_path)) == ("ORC093", "200.0")


@pytest.mark.parametrize(
    ("name", "code", "message", "suggestion"),
    [
        ("models:Parms", "ORC090", "the module 'models' has no class 'Parms'", "models:Params"),
        ("modles:Params", "ORC090", "there is no Python module 'modles'", "models:Params"),
        ("pack.modles.Params", "ORC090", "there is no Python module 'pack.modles'", "pack.models.Params"),
        ("no_models:Params", "ORC090", "there is no Python module 'no_models'", None),
        ("models:Field", "ORC090", "'models:Field' is no model of pydantic", None),
        ("broken:Params", "ORC036", "RuntimeError", None),
    ],
)
def test_a_model_that_is_not_there(
    tmp_path: Path, name: str, code: str, message: str, suggestion: str | None
) -> None:
    written = _YAML.replace("{PARAM}", "{name: rate, value: 2.0}").replace("driver.gpl.yaml", name)
    files = {"a.launch.yaml": written, "models.py": _MODEL, "broken.py": "raise RuntimeError('no')\n"}
    files |= {"pack/__init__.py": "", "pack/models.py": ""}
    (problem,) = checked(tmp_path, files)
    assert (problem.code, problem.suggestion) == (code, suggestion)
    assert message in problem.message


def test_models_of_one_name_in_two_folders_are_two(tmp_path: Path) -> None:
    written = _YAML.replace("{PARAM}", "{name: rate, value: 200.0}").replace(
        "driver.gpl.yaml", "models:Params"
    )
    first = checked(tmp_path / "a", {"a.launch.yaml": written, "models.py": _MODEL})
    second = checked(tmp_path / "b", {"a.launch.yaml": written, "models.py": _MODEL.replace("100", "1000")})
    assert [problem.code for problem in first] == ["ORC093"]
    assert second == ()


_JSON = '{"type": "object", "properties": {"rate": {"type": "number", "x-ros-type": "double", "maximum": 100}}, "additionalProperties": false}'
_PACKAGE = {"demo_pack/__init__.py": "", "demo_pack/nodes/driver.py": "", "demo_pack/nodes/__init__.py": ""}


@pytest.mark.parametrize(
    "file", ["params/driver.schema.json", "config/driver.schema.yaml", "params/driver.schema.yml"]
)
def test_a_schema_is_found_beside_the_parameters_of_a_package(tmp_path: Path, file: str) -> None:
    written = (
        "launch:\n  - node: {pkg: demo_pack, exec: driver, name: any, param: [{name: rate, value: RATE}]}\n"
    )
    files = {**_PACKAGE, f"demo_pack/{file}": _JSON}
    assert checked(tmp_path, {"a.launch.yaml": written.replace("RATE", "20.0"), **files}) == ()
    problems = checked(tmp_path, {"a.launch.yaml": written.replace("RATE", "200.0"), **files})
    assert [(problem.code, problem.severity) for problem in problems] == [("ORC093", "error")]
    problems = checked(
        tmp_path, {"a.launch.yaml": written.replace("rate", "rats").replace("RATE", "2.0"), **files}
    )
    assert [(problem.code, problem.severity) for problem in problems] == [("ORC091", "warning")]


@pytest.mark.parametrize(
    ("text", "codes"), [(_SCHEMA, ["ORC093"]), ("/driver: {ros__parameters: {rate: 2.0}}", [])]
)
def test_a_definition_is_taken_only_for_one_if_it_is_one(tmp_path: Path, text: str, codes: list[str]) -> None:
    written = (
        "launch:\n  - node: {pkg: demo_pack, exec: driver, name: any, param: [{name: rate, value: 200.0}]}\n"
    )
    files = {"a.launch.yaml": written, **_PACKAGE, "demo_pack/config/driver_parameters.yaml": text}
    assert [problem.code for problem in checked(tmp_path, files)] == codes


def test_components_are_checked(tmp_path: Path) -> None:
    written = """\
launch:
  - node_container:
      exec: sleep
      name: box
      namespace: ""
      composable_node:
        - {pkg: demo_pack, plugin: "demo::FastDriver", name: one, param: [{name: rate, value: 200.0}]}
        - {pkg: demo_pack, plugin: "demo::Other", name: two, params_schema: s.json, param: [{name: rate, value: 300.0}]}
"""
    files = {
        "a.launch.yaml": written,
        **_PACKAGE,
        "demo_pack/params/fast_driver.schema.json": _JSON,
        "s.json": _JSON,
    }
    problems = checked(tmp_path, files)
    assert [(problem.code, marked(problem, tmp_path)) for problem in problems] == [
        ("ORC093", "200.0"),
        ("ORC093", "300.0"),
    ]


def test_use_sim_time_is_a_boolean_for_every_node(tmp_path: Path) -> None:
    written = "launch:\n  - node: {exec: sleep, name: a, param: [{name: use_sim_time, value: 'true'}]}\n"
    (problem,) = checked(tmp_path, {"a.launch.yaml": written})
    assert (problem.code, problem.severity, problem.suggestion) == ("ORC092", "error", "true")


def test_a_schema_may_be_named_by_a_substitution(tmp_path: Path) -> None:
    written = _YAML.replace("{PARAM}", "{name: rate, value: 200.0}").replace(
        "driver.gpl.yaml", "$(find-pkg-share demo_pack)/d.yaml"
    )
    files = {"a.launch.yaml": written, **_PACKAGE, "demo_pack/d.yaml": _SCHEMA}
    assert [problem.code for problem in checked(tmp_path, files)] == ["ORC093"]
