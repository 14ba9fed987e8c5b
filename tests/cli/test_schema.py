"""The committed schemas are what the code generates, and real documents fulfil them."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import cache
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any

import jsonschema
import pytest
import yaml

from orchestra.cli.schemas.table import SCHEMAS, schema_text
from orchestra.plan import codec

Command = Callable[..., CompletedProcess[str]]

_ROOT = Path(__file__).parents[2]
_EVERYTHING = """\
launch:
  - arg: {name: who, default: world, choices: [world, moon], description: whom to greet}
  - set_env: {name: MODE, value: test}
  - unset_env: {name: GONE}
  - executable: {cmd: "echo $(var who)", name: greet, cwd: /, ready: {log: "w.*", timeout: 5.0}}
  - executable: {cmd: sleep 1, name: nap, required: true, depends_on: [{process: greet, condition: ready}]}
  - executable: {cmd: sleep 60, name: again, respawn: true, respawn_delay: 2.0}
  - executable: {cmd: echo no, name: never, if: false}
  - timer:
      period: 0.2
      children: [{log: {message: up for a while}}, {executable: {cmd: echo late, name: late}}]
"""


@pytest.fixture
def everything(folder: Path) -> str:
    (folder / "everything.launch.yaml").write_text(_EVERYTHING)
    return "everything.launch.yaml"


@cache
def _validator(name: str) -> jsonschema.Draft202012Validator:
    schema = json.loads((_ROOT / "schemas" / f"{name}.schema.json").read_text("utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def _faults(name: str, document: Any) -> list[str]:
    return [f"{error.json_path}: {error.message}" for error in _validator(name).iter_errors(document)]


@pytest.mark.parametrize("name", SCHEMAS)
def test_the_committed_schema_is_up_to_date(name: str) -> None:
    """Where this fails: `orchestra schema NAME > schemas/NAME.schema.json`."""
    assert (_ROOT / "schemas" / f"{name}.schema.json").read_text("utf-8") == schema_text(name)


def test_every_schema_is_committed_and_no_other() -> None:
    assert {path.name for path in (_ROOT / "schemas").iterdir()} == {
        f"{name}.schema.json" for name in SCHEMAS
    }


@pytest.mark.parametrize("name", SCHEMAS)
def test_the_command_prints_it(orchestra: Command, name: str) -> None:
    found = orchestra("schema", name)
    assert (found.returncode, found.stderr, found.stdout) == (0, "", schema_text(name))


def test_the_launch_schema_is_the_default(orchestra: Command) -> None:
    assert orchestra("schema").stdout == schema_text("launch")


def test_a_plan_fulfils_its_schema(orchestra: Command, everything: str) -> None:
    plan = json.loads(orchestra("plan", everything, "--format", "json").stdout)
    assert _faults("plan", plan) == []
    assert plan["skipped"]
    assert plan["triggers"]
    assert plan["processes"][0]["ready"]


@pytest.mark.parametrize("path", sorted(_ROOT.glob("bringup/*.yaml")), ids=lambda path: path.name)
def test_the_plans_and_files_of_the_bringup_fulfil_their_schemas(orchestra: Command, path: Path) -> None:
    assert _faults("launch", yaml.safe_load(path.read_text("utf-8"))) == []
    if path.name == "two_robots.yaml":
        found = orchestra("plan", str(path), "--format", "json")
        assert found.returncode == 0
        assert _faults("plan", json.loads(found.stdout)) == []
        assert codec.encode(codec.loads(found.stdout)) == json.loads(found.stdout)


@pytest.mark.parametrize(
    ("field", "value"),
    [("version", 2), ("file", None), ("processes", {}), ("extra", 1), ("arguments", [{"name": "x"}])],
)
def test_what_is_no_plan_does_not(orchestra: Command, everything: str, field: str, value: object) -> None:
    plan = json.loads(orchestra("plan", everything, "--format", "json").stdout)
    assert _faults("plan", {**plan, field: value})


def test_a_process_without_a_field_is_no_process(orchestra: Command, everything: str) -> None:
    plan = json.loads(orchestra("plan", everything, "--format", "json").stdout)
    for field in plan["processes"][0]:
        process = {name: value for name, value in plan["processes"][0].items() if name != field}
        assert _faults("plan", {**plan, "processes": [process]}), field


def test_problems_fulfil_their_schema(orchestra: Command, folder: Path) -> None:
    (folder / "bad.launch.yaml").write_text("launch:\n  - executable: {cmd: x, nmae: y}\n  - nod: {}\n")
    problems = json.loads(orchestra("check", "bad.launch.yaml", "--format", "json").stdout)
    assert len(problems) == 2
    assert [_faults("problem", problem) for problem in problems] == [[], []]
    assert _faults("problem", {**problems[0], "severity": "fatal"})
    assert _faults("problem", {**problems[0], "line": 0})


def test_events_of_a_run_fulfil_their_schema(orchestra: Command, everything: str, home: Path) -> None:
    assert orchestra("launch", everything).returncode == 0
    (stream,) = home.glob("runs/*/events.jsonl")
    events = [json.loads(line) for line in stream.read_text("utf-8").splitlines()]
    assert len(events) > 10
    assert [fault for event in events for fault in _faults("event", event)] == []
    assert _faults("event", {**events[0], "kind": "nothing_happened"})


def test_a_launch_file_fulfils_its_schema_unless_a_key_is_misspelt() -> None:
    assert _faults("launch", yaml.safe_load(_EVERYTHING)) == []
    assert _faults("launch", yaml.safe_load(_EVERYTHING.replace("cwd:", "cdw:")))
