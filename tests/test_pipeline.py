"""From a launch file to its plan: what is the same description gives the same plan, everywhere and every time."""

from __future__ import annotations

import gc
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from orchestra import pipeline
from orchestra.errors import Code, DescriptionError
from orchestra.plan.codec import dumps, loads

_ROOT = Path(__file__).parents[1]
_TWO_ROBOTS = _ROOT / "bringup" / "two_robots.yaml"
_BY_HAND = _ROOT / "tests" / "data" / "two_robots_by_hand.yaml"


def _plan(path: Path, *words: str, cwd: Path = _ROOT, **environment: str) -> str:
    """Return what `orchestra plan` prints, from a process of its own."""
    done = subprocess.run(
        [sys.executable, "-m", "orchestra", "plan", str(path), *words, "--format", "json"],
        cwd=cwd,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=100,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def _without_places(value: Any) -> Any:
    """Return JSON data without locations and provenance."""
    if isinstance(value, dict):
        return {
            key: _without_places(item)
            for key, item in value.items()
            if key not in {"file", "location", "provenance"}
        }
    return [_without_places(item) for item in value] if isinstance(value, list) else value


@pytest.mark.parametrize("words", [(), ("world:=maze", "duration:=60", "mode:=hold", "log_level:=debug")])
def test_an_include_written_out_by_hand_gives_the_same_plan(words: tuple[str, ...]) -> None:
    included, by_hand = (json.loads(_plan(path, *words)) for path in (_TWO_ROBOTS, _BY_HAND))
    assert [process["id"] for process in included["processes"]] == [
        "/simulation",
        *("/robot1/ekf", "/robot1/velocity_controller", "/robot2/ekf", "/robot2/velocity_controller"),
    ]
    assert _without_places(included) == _without_places(by_hand)
    assert included["processes"] != by_hand["processes"], "the places differ"


def test_planning_twice_gives_the_same_bytes_whatever_the_hash_seed() -> None:
    assert _plan(_TWO_ROBOTS, PYTHONHASHSEED="1") == _plan(_TWO_ROBOTS, PYTHONHASHSEED="4711")


def test_in_another_working_directory_only_displayed_paths_differ(tmp_path: Path) -> None:
    here, there = _plan(_TWO_ROBOTS), _plan(_TWO_ROBOTS, cwd=tmp_path)
    assert here != there
    assert here.replace('"bringup/', f'"{_ROOT}/bringup/') == there


def test_faults_come_in_the_same_order_every_time(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text(
        "launch:\n- include: {file: b.yaml}\n- ndoe: {}\n- node: {exec: a, nmae: $(vra b), colour: c, shape: d}\n"
    )
    (tmp_path / "b.yaml").write_text("launch:\n- lgo: {}\n- log: {message: $(var x)}\n")
    runs = {_faults(tmp_path, seed) for seed in ("0", "1", "2")}
    assert len(runs) == 1


def _faults(folder: Path, seed: str) -> str:
    done = subprocess.run(
        [sys.executable, "-m", "orchestra", "check", "a.yaml", "--format", "json"],
        cwd=folder,
        env={**os.environ, "PYTHONHASHSEED": seed},
        capture_output=True,
        text=True,
        timeout=100,
        check=False,
    )
    assert done.returncode == 2
    assert len(json.loads(done.stdout)) == 7
    return done.stdout


def test_a_plan_survives_json_and_so_does_text_that_is_no_unicode(tmp_path: Path) -> None:
    path = tmp_path / "a.yaml"
    path.write_text("launch:\n- arg: {name: w}\n- executable: {cmd: echo $(var w)}\n")
    inputs = pipeline.inputs_from(["w:=\udcff"], environment={"PATH": "/bin"})
    plan = pipeline.make_plan(str(path), inputs)
    text = dumps(plan)
    assert text.encode("utf-8")
    assert loads(text) == plan
    assert plan.processes[0].command == ("echo", "\udcff")


def test_a_plan_with_warnings_is_a_plan_and_one_with_errors_is_none(tmp_path: Path) -> None:
    path = tmp_path / "a.yaml"
    inputs = pipeline.inputs_from([], environment={"PATH": "/bin"})
    path.write_text("launch: {deprecated: use b.yaml, children: []}\n")
    plan = pipeline.make_plan(str(path), inputs)
    assert [(problem.code, problem.message) for problem in plan.problems] == [
        (Code.DEPRECATED, f"{path} is deprecated: use b.yaml")
    ]
    assert pipeline.check(str(path), inputs) == plan.problems
    path.write_text("launch: {deprecated: use b.yaml, children: [{lgo: {}}]}\n")
    with pytest.raises(DescriptionError) as caught:
        pipeline.make_plan(str(path), inputs)
    assert [problem.code for problem in caught.value.problems] == [Code.DEPRECATED, Code.UNKNOWN_ACTION]


def test_the_garbage_collector_is_left_as_it_was(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text("launch: []\n")
    inputs = pipeline.inputs_from([], environment={})
    pipeline.check(str(tmp_path / "a.yaml"), inputs)
    assert gc.isenabled()
    gc.disable()
    try:
        pipeline.check(str(tmp_path / "a.yaml"), inputs)
        assert not gc.isenabled()
    finally:
        gc.enable()


def test_what_only_explains_faults_is_not_imported_where_there_is_none() -> None:
    program = (
        "import sys\n"
        "from orchestra.pipeline import inputs_from, make_plan\n"
        "make_plan('bringup/two_robots.yaml', inputs_from([], environment={}))\n"
        "print([name for name in sys.argv[1:] if name in sys.modules])\n"
    )
    explaining = (
        "orchestra.compat.suggestions",
        "orchestra.compat.syntax_trees",
        "orchestra.load.yaml_faults",
    )
    done = subprocess.run(
        [sys.executable, "-c", program, *explaining], capture_output=True, text=True, check=True, cwd=_ROOT
    )
    assert done.stdout == "[]\n"
