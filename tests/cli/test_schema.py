"""The committed schemas are what the code generates, and real documents fulfil them."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any

import jsonschema
import pytest
import yaml

from orchestra.cli.schemas.table import FILES, SCHEMAS, schema_text
from orchestra.errors import Code, Problems
from orchestra.load.files import load
from orchestra.plan import codec
from orchestra.resolve.rcl.files import read_parameter_file
from tests.cli.core_yaml import core
from tests.mistakes.corpus import cases

Command = Callable[..., CompletedProcess[str]]


@pytest.fixture
def orchestra(orchestra_quickly: Command) -> Command:
    """Run the command; what starts nothing, in this process."""
    return orchestra_quickly


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


@pytest.mark.parametrize("name", FILES)
def test_the_committed_schema_is_up_to_date(name: str) -> None:
    """Where this fails: `orchestra schema NAME > schemas/...`."""
    assert (_ROOT / "schemas" / FILES[name]).read_text("utf-8") == schema_text(name)


def test_every_schema_is_committed_and_no_other() -> None:
    assert {path.name for path in (_ROOT / "schemas").iterdir()} == set(FILES.values())


@pytest.mark.parametrize("name", FILES)
def test_the_command_prints_it(orchestra: Command, name: str) -> None:
    found = orchestra("schema", name)
    assert (found.returncode, found.stderr, found.stdout) == (0, "", schema_text(name))


def test_the_launch_schema_is_the_default(orchestra_beside: Command) -> None:
    assert orchestra_beside("schema").stdout == schema_text("launch")


def test_a_plan_fulfils_its_schema(orchestra: Command, everything: str) -> None:
    plan = json.loads(orchestra("plan", everything, "--format", "json").stdout)
    assert _faults("plan", plan) == []
    assert plan["skipped"]
    assert plan["triggers"]
    assert plan["processes"][0]["ready"]


_GOOD = [
    *(("launch", path) for path in sorted(_ROOT.glob("bringup/*.yaml"))),
    *(("launch", path) for path in sorted(_ROOT.glob("tests/data/ordinary/*.yaml"))),
    *(("params", path) for path in sorted(_ROOT.glob("bringup/params/**/*.yaml"))),
    *(("params", path) for path in sorted(_ROOT.glob("tests/data/**/config/*.yaml"))),
]


@pytest.mark.parametrize(("name", "path"), _GOOD, ids=[path.name for _, path in _GOOD])
def test_files_that_work_fulfil_their_schema(name: str, path: Path) -> None:
    assert _faults(name, core(path.read_text("utf-8"))) == []


# Lists of robots are neither launch nor parameter files.
_DESCRIBED = [path for path in sorted(_ROOT.glob("bringup/**/*.yaml")) if path.parent.name != "robots"]


@pytest.mark.parametrize("path", _DESCRIBED, ids=lambda path: path.name)
def test_a_file_of_the_bringup_names_its_schema(path: Path) -> None:
    """An editor takes the path as one from the folder of the file, and so does whoever clones the repository."""
    modeline = path.read_text("utf-8").partition("\n")[0]
    named = modeline.removeprefix("# yaml-language-server: $schema=")
    name = "params" if "params" in path.parts else "launch"
    assert (path.parent / named).resolve() == _ROOT / "schemas" / f"{name}.schema.json"


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


def test_differences_and_explanations_fulfil_their_schemas(
    orchestra: Command, everything: str, folder: Path
) -> None:
    (folder / "one.launch.yaml").write_text("launch:\n  - executable: {cmd: 'true', name: one}\n")
    compared = orchestra("plan", everything, "--format", "json", "--diff", "one.launch.yaml")
    difference = json.loads(compared.stdout)
    assert difference["processes"]
    assert _faults("difference", difference) == []
    assert _faults("difference", {**difference, "version": 2})
    plan = json.loads(orchestra("plan", everything, "--format", "json").stdout)
    subject = plan["processes"][0]["id"]
    explained = json.loads(orchestra("plan", everything, "--format", "json", "--explain", subject).stdout)
    assert _faults("explanation", explained) == []
    assert _faults("explanation", {**explained, "explained": [{"id": subject}]})


def test_problems_fulfil_their_schema(orchestra: Command, folder: Path) -> None:
    (folder / "bad.launch.yaml").write_text("launch:\n  - executable: {cmd: x, nmae: y}\n  - nod: {}\n")
    problems = json.loads(orchestra("check", "bad.launch.yaml", "--format", "json").stdout)
    assert len(problems) == 2
    assert [_faults("problem", problem) for problem in problems] == [[], []]
    assert _faults("problem", problems) == _faults("problem", []) == []
    for wrong in ({"severity": "fatal"}, {"line": 0}):
        assert _faults("problem", {**problems[0], **wrong})
        assert _faults("problem", [problems[1], {**problems[0], **wrong}])


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


def _described(schema: Any, place: str, definitions: dict[str, Any]) -> list[str]:
    """Return the places of keys that an editor could say nothing of."""
    if not isinstance(schema, dict):
        return []
    missing = []
    for key, value in schema.get("properties", {}).items():
        silent = isinstance(value, dict) and not (
            value.get("description") or definitions[value["$ref"].split("/")[-1]].get("description")
        )
        missing.extend([f"{place}.{key}"] * silent)
        missing.extend(_described(value, f"{place}.{key}", definitions))
    for key in ("$defs", "patternProperties"):
        for name, value in schema.get(key, {}).items():
            missing.extend(_described(value, f"{place}/{name}", definitions))
    return missing


@pytest.mark.parametrize("name", ["launch", "params"])
def test_an_editor_can_say_something_of_every_key(name: str) -> None:
    schema = SCHEMAS[name]()
    assert _described(schema, name, schema["$defs"]) == []


@pytest.mark.parametrize("name", ["launch", "params"])
def test_alternatives_are_told_apart(name: str) -> None:
    """What fails in `anyOf` of whole values is told without its place: only words and missing keys stand there."""
    told = [item for items in _alternatives(SCHEMAS[name]()) for item in items]
    assert {key for item in told for key in item} <= {"enum", "pattern", "required"}


def _alternatives(schema: Any) -> Iterator[list[Any]]:
    if isinstance(schema, dict):
        for key, value in schema.items():
            if key in ("anyOf", "oneOf"):
                yield value
            yield from _alternatives(value)
    elif isinstance(schema, list):
        for item in schema:
            yield from _alternatives(item)


# What concerns the structure of a file: keys, types, and which keys go together.
_STRUCTURE = {
    Code.UNKNOWN_KEY,
    Code.WRONG_TYPE,
    Code.MISSING_KEY,
    Code.UNKNOWN_ACTION,
    Code.CONFLICTING_KEYS,
}


def _mistaken() -> Iterator[tuple[str, str]]:
    for case in cases(_ROOT / "tests" / "mistakes" / "yaml.txt", "case.launch.yaml"):
        yield from ((case.title, text) for name, text in case.files.items() if name.endswith(".launch.yaml"))


def test_what_is_wrong_with_the_structure_of_a_launch_file_the_schema_refuses(folder: Path) -> None:
    """Measured on the table of mistakes."""
    refused = 0
    for title, text in _mistaken():
        file, problems = folder / "case.launch.yaml", Problems()
        file.write_text(text, "utf-8")
        if load(str(file), problems) is None and any(item.code not in _STRUCTURE for item in problems):
            continue  # no YAML
        codes = {problem.code for problem in problems.errors}
        try:
            faults = _faults("launch", core(text))
        except yaml.YAMLError:
            continue  # a tag, or a key twice: an editor says so without a schema
        if codes & _STRUCTURE:
            assert faults, title
            refused += 1
    assert refused > 80


_RULES = [
    ("node: {exec: a, if: true, unless: false}", "node: {exec: a, if: true}"),
    ("node: {exec: a, param: [{name: x}]}", "node: {exec: a, param: [{name: x, value: 1}]}"),
    ("node: {exec: a, param: [{value: 1}]}", "node: {exec: a, param: [{from: x.yaml}]}"),
    ("node: {exec: a, param: [{name: x, from: y}]}", "node: {exec: a, param: [{name: x, param: []}]}"),
    ("node: {exec: a, param: [{name: x, value: 1, param: []}]}", "node: {exec: a, param: []}"),
    (
        "node: {exec: a, param: [{name: x, value: 1, allow_substs: true}]}",
        "node: {exec: a, param: [{from: x, allow_substs: true}]}",
    ),
    (
        "node: {exec: a, param: [{from: x, type: str}]}",
        "node: {exec: a, param: [{name: x, value: 1, type: str}]}",
    ),
    ("set_parameter: {name: x}", "set_parameter: {name: x, value: [1, 2]}"),
    ("set_parameter: {name: x, value: 1, param: []}", "set_parameter: {name: x, param: []}"),
    ("node: {exec: a, depends_on: [{condition: ready}]}", "node: {exec: a, depends_on: [{node: b}]}"),
    ("node: {exec: a, depends_on: [{node: b, label: c}]}", "node: {exec: a, depends_on: [{label: c}]}"),
    ("node: {exec: a, ready: {timeout: 5}}", "node: {exec: a, ready: {timeout: 5, log: x}}"),
    ("node: {exec: a, ready: {log: x, interval: 1}}", "node: {exec: a, ready: {tcp: x, interval: 1}}"),
    ("node: {exec: a, alive: {timeout: 5}}", "node: {exec: a, alive: {command: x, timeout: 5}}"),
    ("node: {exec: a, alive: {message: x}}", "node: {exec: a, alive: {message: x, min_rate: 5}}"),
    ("node: {exec: a, limits: {exclusive: true}}", "node: {exec: a, limits: {exclusive: true, cores: 1}}"),
    (
        "node: {exec: a, limits: {priority: 5}}",
        "node: {exec: a, limits: {priority: 5, scheduler: fifo}}",
    ),
    (
        "node: {exec: a, limits: {memory_lock: 1, rlimits: {memlock: 1}}}",
        "node: {exec: a, limits: {memory_lock: 1, rlimits: {core: 1}}}",
    ),
    ("node: {exec: a, restart: always, respawn: true}", "node: {exec: a, respawn: true, respawn_delay: 1}"),
    ("node: {exec: a, output: {stdin: log}}", "node: {exec: a, output: {stdout: [screen, log]}}"),
    ("node: {exec: a, restart: sometimes}", "node: {exec: a, restart: {policy: always}}"),
    ("node: {exec: a, respawn: maybe}", "node: {exec: a, respawn: True, shell: $(var x)}"),
    ("group: {}", "group: [{reset: }]"),
    ("set_env: {name: a}", "set-env: {name: a, value: b}"),
]


@pytest.mark.parametrize(("bad", "good"), _RULES)
def test_the_schema_says_what_the_models_say(folder: Path, bad: str, good: str) -> None:
    for text, sound in ((bad, False), (good, True)):
        file, problems = folder / "a.launch.yaml", Problems()
        file.write_text(f"launch:\n  - {text}\n")
        load(str(file), problems)
        assert not problems.errors if sound else problems.errors, text
        assert (_faults("launch", core(file.read_text())) == []) is sound, text


_PARAMETERS = [
    ("/**: {a: 1}", "/**: {ros__parameters: {a: 1}}"),
    ("/**: {ros_parameters: {a: 1}}", "/**/n: {ros__parameters: {}}"),
    ("a b: {ros__parameters: {}}", "ns: {n: {ros__parameters: {a: {b: {c: [1, 2]}}}}}"),
    ("/n: {ros__parameters: }", ""),
    ("/n: {ros__parameters: {a: }}", "/n: {ros__parameters: {a: 0x1F, b: 1e-6, c: y, d: '1', e: ~x}}"),
    ("/n: {ros__parameters: {a: [1, x]}}", "/n: {ros__parameters: {a: [1.0, nan, .inf], b: [true, on, n]}}"),
    ("/n: {ros__parameters: {a: [x, 1]}}", "/n: {ros__parameters: {a: [], c: [x, '1']}}"),
    ("ros__parameters: {a: 1}", "/*/n: {ros__parameters: {use_sim_time: true, 1: 2, a.b: 3}}"),
    ("- a", "/ns/n: {ros__parameters: {a: $(var x), b: [$(var y), 1]}}"),
    ("$(var n): {a: 1}", "'$(var ns)/n': {ros__parameters: {a: 1}}"),
    ("/ns: {$(var n): 1}", "/ns: {'n_$(var m)/sub': {ros__parameters: {}}}"),
]


@pytest.mark.parametrize(("bad", "good"), _PARAMETERS)
def test_the_schema_of_parameter_files_says_what_rcl_says(bad: str, good: str) -> None:
    for text, sound in ((bad, False), (good, True)):
        problems = Problems()
        read_parameter_file(text, "a.yaml", problems)
        if "$(" not in text:
            assert not problems.errors if sound else problems.errors, text
        assert (_faults("params", core(text)) == []) is sound, text
