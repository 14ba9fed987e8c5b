"""What upstream was recorded to accept in YAML is accepted, and the other way round but for the named differences."""

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
        "- log: {message: 5}",
    },
    "a number of seconds is any number, in quotes or not": {
        "- executable: {cmd: ls, respawn_delay: 2}",
        "- executable: {cmd: ls, respawn_delay: '2.0'}",
        "- executable: {cmd: ls, sigterm_timeout: 3}",
        "- executable: {cmd: ls, sigterm_timeout: '3'}",
        "- timer: {period: 1, children: []}",
    },
    "an empty list is a list": {"- executable: {cmd: ls, env: []}"},
    "an action without keys may have nothing behind it": {"- shutdown:"},
    "a type reads the value, however it is written": {
        "- node: {pkg: p, exec: e, param: [{name: a, value: 1, type: str}]}",
        "- node: {pkg: p, exec: e, param: [{name: a, value: '1', type: int}]}",
        "- node: {pkg: p, exec: e, param: [{from: f.yaml, allow_substs: 'true'}]}",
    },
    "`-` and `_` are alike": {"- executable: {cmd: ls, launch_prefix: gdb}"},
    "newer releases have it": {"- include: {file: f, let: [{name: a, value: b}]}"},
    "the values of a list are typed when the file is resolved": {
        "- node: {pkg: p, exec: e, param: [{name: a, value: [1, x]}]}"
    },
}
# Actions of upstream that are not supported yet. They are refused by name, never taken for a slip.
_LATER = (
    *("node_container", "load_composable_node", "append_env", "reset_env", "reset", "set_use_sim_time"),
    *("set_parameters_from_file", "set_ros_log_dir", "ros_timer"),
)


def _records() -> list[tuple[str, bool]]:
    lines = _PROBES.read_text("utf-8").splitlines()
    return [(record["in"], record["ok"]) for record in map(json.loads, lines) if record["k"] == "yaml"]


def _problems(text: str, folder: Path) -> Problems:
    path = folder / "probe.launch.yaml"
    path.write_text(f"launch:\n{text}\n")
    problems = Problems()
    load(str(path), problems)
    return problems


def _is_later(text: str) -> bool:
    return text.removeprefix("- ").partition(":")[0] in _LATER


@pytest.mark.parametrize(("text", "accepted"), [record for record in _records() if not _is_later(record[0])])
def test_upstreams_judgement_is_kept(text: str, accepted: bool, tmp_path: Path) -> None:
    problems = list(_problems(text, tmp_path))
    differs = any(text in texts for texts in _ACCEPTED.values())
    assert (not problems) is (accepted or differs), problems
    assert len(problems) <= 1, "a mistake is told once"
    assert not (accepted and differs), "this is no difference any more"


@pytest.mark.parametrize("text", [text for text, _ in _records() if _is_later(text)])
def test_what_is_still_to_come_is_refused_by_name(text: str, tmp_path: Path) -> None:
    (problem,) = _problems(text, tmp_path)
    assert problem.message.endswith("is not supported yet")
    assert problem.suggestion is None
