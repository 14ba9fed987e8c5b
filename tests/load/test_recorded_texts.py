"""What upstream was recorded to make of texts comes out of whole files, written in YAML and in XML."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.load.planning import planned
from tests.load.written import WRITERS, Actions

_RECORDS = [
    json.loads(line)
    for line in Path(__file__).parents[1].joinpath("data/launch-probes.jsonl").read_text("utf-8").splitlines()
]
_SET: Actions = [
    {"let": {"name": name, "value": value}}
    for name, value in {"a": "A", "b": "true", "n": "3", "name": "a"}.items()
]
_ENVIRONMENT = {"PATH": "/usr/bin:/bin", "E1": "envval"}

# Where it comes out differently here, by reason.
_DIFFERENT: dict[str, dict[str, Any]] = {
    "any run of spaces separates": {"$(var  a)": "A", "$( var a)": "A", "$(var a )": "A"},
    "the last line break of what a command prints goes": {
        '$(command "echo hi")': "hi",
        "$(command 'echo hi')": "hi",
    },
    "newer releases have it": {"$(path-join a b)": "a/b", "$(string-join a b)": "b"},
    "the records had no current file": {"$(dirname)": "{folder}", "$(filename)": "{folder}/a.launch"},
    "one rule reads every boolean": {"yes": True, "on": True},
}
_BY_TEXT = {text: result for texts in _DIFFERENT.values() for text, result in texts.items()}

_both = pytest.mark.parametrize("language", sorted(WRITERS))


def _recorded(kind: str) -> Any:
    records = {record["in"]: record.get("out") for record in _RECORDS if record["k"] == kind}
    return pytest.mark.parametrize(("text", "result"), list(records.items()))


@pytest.mark.conforms("3.2 names", "D12", "D43", "D66")
@_both
@_recorded("subst")
def test_substitutions(tmp_path: Path, language: str, text: str, result: str | None) -> None:
    result = _BY_TEXT.get(text, result)
    if result is not None:
        result = (
            result.format(folder=tmp_path, file=tmp_path / f"a.launch.{language}")
            if "{" in result
            else result
        )
    plan = planned(tmp_path, language, [*_SET, {"log": {"message": text}}], _ENVIRONMENT)
    assert plan.failed == (result is None)
    if result is not None:
        assert plan.messages == [result]


@pytest.mark.conforms(
    "2.8 shell words", "2.8 substitutions in words", "2.8 an empty word", "2.8 a backslash", "2.8 nothing"
)
@_both
@_recorded("argv")
def test_words_of_a_command(tmp_path: Path, language: str, text: str, result: list[str]) -> None:
    plan = planned(tmp_path, language, [*_SET, {"executable": {"cmd": text}}], _ENVIRONMENT)
    assert [process["command"] for process in plan.processes] == [result]


@pytest.mark.conforms("2.7 words", "D13")
@_both
@_recorded("if")
@pytest.mark.parametrize("key", ["if", "unless"])
def test_conditions(tmp_path: Path, language: str, key: str, text: str, result: bool | None) -> None:
    result = _BY_TEXT.get(text, result)
    plan = planned(tmp_path, language, [{"log": {"message": "said", key: text}}], _ENVIRONMENT)
    assert plan.failed == (result is None)
    if result is not None:
        assert plan.messages == (["said"] if result is (key == "if") else [])


@pytest.mark.conforms("2.6 bool", "D13")
@_both
@_recorded("bool")
@pytest.mark.parametrize("form", ["{}", "$(var none '{}')"])
def test_booleans(tmp_path: Path, language: str, form: str, text: str, result: bool | None) -> None:
    """Whether a flag is known when the file is read or when it is evaluated, it reads the same."""
    process = {"executable": {"cmd": "a", "shell": form.format(text)}}
    plan = planned(tmp_path, language, [process], _ENVIRONMENT)
    assert plan.failed == (result is None)
    if result is not None:
        assert [process["shell"] for process in plan.processes] == [result]
