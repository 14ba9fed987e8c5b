"""What upstream was recorded to accept is accepted, and the other way round but for the named differences."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from orchestra.errors import Problems
from orchestra.load.files import load

_PROBES = Path(__file__).parents[1] / "data" / "launch-probes.jsonl"

# Accepted here although upstream refuses it, by reason (the reference's list of what to fix and not to copy).
_ACCEPTED = {
    "native booleans and numbers stand where text does": {
        "- arg: {name: a, default: 5}",
        "- arg: {name: a, default: true}",
        "- let: {name: a, value: 1}",
        "- executable: {cmd: ls, if: false}",
        "- executable: {cmd: ls, respawn: true}",
        "- executable: {cmd: ls, env: [{name: A, value: 1}]}",
        "- include: {file: f, arg: [{name: a, value: 1}]}",
        "- set_parameter: {name: a, value: 1}",
        "- set_use_sim_time: {value: true}",
        "- node_container: {pkg: p, exec: e, name: n, namespace: /, composable_node:"
        " [{pkg: p, plugin: P, name: c, extra_arg: [{name: u, value: true}]}]}",
        "- log: {message: 5}",
    },
    "a number of seconds is any number, in quotes or not": {
        "- executable: {cmd: ls, respawn_delay: 2}",
        "- executable: {cmd: ls, respawn_delay: '2.0'}",
        "- executable: {cmd: ls, sigterm_timeout: 3}",
        "- executable: {cmd: ls, sigterm_timeout: '3'}",
        "- timer: {period: 1, children: []}",
    },
    "a boolean is one in quotes too": {
        "- append_env: {name: a, value: b, prepend: 'true'}",
        "- ros_timer: {period: 1.0, cancel_on_shutdown: 'true', children: []}",
    },
    "an empty list is a list": {"- executable: {cmd: ls, env: []}"},
    "an action without keys may have nothing behind it": {"- shutdown:", "- reset_env:"},
    "a type reads the value, however it is written": {
        "- node: {pkg: p, exec: e, param: [{name: a, value: 1, type: str}]}",
        "- node: {pkg: p, exec: e, param: [{name: a, value: '1', type: int}]}",
        "- node: {pkg: p, exec: e, param: [{from: f.yaml, allow_substs: 'true'}]}",
    },
    "what Python can say has a form here": {
        "- executable: {cmd: [ls, -l]}",
        "- executable: {cmd: ls, output: {stdout: screen}}",
    },
    "`-` and `_` are alike": {"- executable: {cmd: ls, launch_prefix: gdb}"},
    "newer releases have it": {"- include: {file: f, let: [{name: a, value: b}]}"},
    "a component is called as its class where no name is given, as in Python": {
        "- node_container: {pkg: p, exec: e, name: n, namespace: /, composable_node: [{pkg: p, plugin: P}]}"
    },
    "the values of a list are typed when the file is resolved": {
        "- node: {pkg: p, exec: e, param: [{name: a, value: [1, x]}]}",
        '<launch><node pkg="p" exec="e"><param name="b" value="1;x" value-sep=";"/></node></launch>',
        '<launch><node pkg="p" exec="e"><param name="b" value="1,2" type="list_of_int"/></node></launch>',
    },
}
# Refused here although upstream accepts it, by reason.
_REFUSED = {
    "a word that is no boolean counts as true there": {'<launch><group scoped="maybe"/></launch>'},
}


def _records(kind: str) -> list[tuple[str, bool]]:
    lines = _PROBES.read_text("utf-8").splitlines()
    return [(record["in"], record["ok"]) for record in map(json.loads, lines) if record["k"] == kind]


def _problems(text: str, path: Path) -> Problems:
    path.write_text(text, "utf-8")
    problems = Problems()
    load(str(path), problems)
    return problems


@pytest.mark.conforms("2.1 root", "D6", "D7", "D10", "D62", "D63", "D64", "D65")
@pytest.mark.parametrize(("text", "accepted"), _records("yaml"))
def test_upstreams_judgement_of_yaml_is_kept(text: str, accepted: bool, tmp_path: Path) -> None:
    _judge(text, accepted, _problems(f"launch:\n{text}\n", tmp_path / "probe.launch.yaml"))


@pytest.mark.conforms("2.1 root")
@pytest.mark.parametrize(("text", "accepted"), _records("xml"))
def test_upstreams_judgement_of_xml_is_kept(text: str, accepted: bool, tmp_path: Path) -> None:
    _judge(text, accepted, _problems(text, tmp_path / "probe.launch.xml"))


def _judge(text: str, accepted: bool, problems: Problems) -> None:
    named = _REFUSED if accepted else _ACCEPTED
    differs = any(text in texts for texts in named.values())
    assert (not problems.errors) is (accepted is not differs), list(problems)
    assert len({problem.code for problem in problems}) <= 1, "a mistake is told once"


def test_every_named_difference_was_recorded() -> None:
    records = dict([*_records("yaml"), *_records("xml")])
    assert {text for texts in _ACCEPTED.values() for text in texts} <= {
        text for text, ok in records.items() if not ok
    }
    assert {text for texts in _REFUSED.values() for text in texts} <= {
        text for text, ok in records.items() if ok
    }
