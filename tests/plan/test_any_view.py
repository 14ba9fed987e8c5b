"""Whatever a launch file comes to can be shown in every form, and all of it can be explained."""

from __future__ import annotations

import json
import subprocess
from typing import TYPE_CHECKING

import pytest
from hypothesis import HealthCheck, given, settings

from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan import codec
from orchestra.plan.explaining import explain
from orchestra.plan.portable import portable
from orchestra.plan.render import explanation
from orchestra.plan.render.formats import FORMATS
from orchestra.plan.selected import selected
from tests.plan.strategies import Actions, descriptions, inner_actions

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Component, Plan, Process

_quickly = settings(
    deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow]
)


def _planned(folder: Path, written: Actions, inner: Actions) -> Plan:
    for name, content in (("main.launch.yaml", written), ("inner.launch.yaml", inner)):
        (folder / name).write_text(json.dumps({"launch": content}))
    made = collect(str(folder / "main.launch.yaml"), inputs_from([], environment={"A_1": "x"}), Problems())
    assert made is not None
    return made


@given(descriptions, inner_actions)
@settings(_quickly, max_examples=30)
def test_every_form_can_be_made_and_the_script_is_bash(
    tmp_path: Path, written: Actions, inner: Actions
) -> None:
    made = _planned(tmp_path, written, inner)
    texts = {name: render(made) for name, render in FORMATS.items() if name != "svg"}
    assert all(texts.values())
    done = subprocess.run(
        ["bash", "-n"], input=texts["sh"].encode(), capture_output=True, timeout=60, check=False
    )
    assert (done.returncode, done.stderr) == (0, b"")


@given(descriptions, inner_actions)
@settings(_quickly, max_examples=40)
def test_everything_can_be_explained_and_the_winner_is_the_value(
    tmp_path: Path, written: Actions, inner: Actions
) -> None:
    made = _planned(tmp_path, written, inner)
    for record in _records(made):
        assert explanation.render(explain(made, record.id, {}))
        for subject in _subjects(record):
            (found,) = explain(made, subject, {}).values
            won = [candidate for candidate in found.candidates if candidate.won]
            assert len(won) <= 1
            assert all(candidate.rule for candidate in found.candidates)
            if found.subject != "remapping" and won:
                assert codec.encode(found.value) == codec.encode(won[0].value)
            assert explanation.render(explain(made, subject, {}))


def _records(made: Plan) -> list[Process | Component]:
    return [*made.processes, *made.components]


def _subjects(record: Process | Component) -> list[str]:
    return [
        *(f"{record.id}.{name}" for name in record.provenance.parameters),
        *(f"{record.id}:{source}" for source, _ in record.remappings),
        *(f"{record.id}${name}" for name in record.provenance.environment),
    ]


@given(descriptions, inner_actions)
@settings(_quickly, max_examples=20)
def test_parts_hold_what_they_are_asked_for_and_nothing_else(
    tmp_path: Path, written: Actions, inner: Actions
) -> None:
    made = _planned(tmp_path, written, inner)
    ids = [record.id for record in _records(made)]
    for wanted in ids:
        part = selected(made, {wanted})
        kept = {record.id for record in _records(part)}
        held = {component.id for component in made.components if component.process == wanted}
        assert kept == {wanted} | held
        assert FORMATS["sh"](part)
    assert selected(made, ids).processes == made.processes


@pytest.mark.parametrize("path", ["/opt/x", "/opt/x.y"])
def test_only_whole_paths_are_made_symbolic(tmp_path: Path, path: str) -> None:
    words = [path, f"{path}/z", f"{path}.bak", f"/data{path}", f"--dir={path}", f"{path}:/other"]
    content = [{"executable": {"cmd": ["echo", *words], "name": "e"}}]
    made = portable(_planned(tmp_path, content, []), {path: "${share:x}", f"{path}/z": "${share:z}"})
    assert list(made.processes[0].command[1:]) == [
        *("${share:x}", "${share:z}", f"{path}.bak", f"/data{path}"),
        *("--dir=${share:x}", "${share:x}:/other"),
    ]
