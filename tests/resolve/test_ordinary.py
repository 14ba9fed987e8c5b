"""Ordinary launch files, written as people write them for nav2, TurtleBots and cameras, give no word of warning."""

from __future__ import annotations

from pathlib import Path

import pytest

from orchestra.errors import Code, Problems
from orchestra.pipeline import collect, inputs_from

_ORDINARY = Path(__file__).parents[1] / "data" / "ordinary"
_ENVIRONMENT = {"PATH": "/usr/bin:/bin"}

RUNS: dict[str, tuple[tuple[str, ...], int]] = {
    "bringup.launch.yaml": ((), 3),
    "bringup.launch.yaml slam:=True": (("slam:=True",), 4),
    "bringup.launch.yaml use_composition:=False": (("use_composition:=False",), 5),
    "simulation.launch.yaml": ((), 4),
    "simulation.launch.yaml gui:=false": (("gui:=false", "x_pose:=1.0"), 3),
    "robot.launch.yaml": (("namespace:=robot1",), 3),
    "fleet.launch.yaml": ((), 10),
    "fleet.launch.yaml rviz:=true": (("rviz:=true",), 11),
    "perception.launch.yaml": ((), 3),
    "perception.launch.yaml optional_config:=x": (("optional_config:=x",), 5),
}


@pytest.mark.parametrize("run", RUNS)
def test_nothing_is_found_wrong(run: str) -> None:
    words, count = RUNS[run]
    problems = Problems()
    plan = collect(
        str(_ORDINARY / run.partition(" ")[0]), inputs_from(words, environment=_ENVIRONMENT), problems
    )
    assert list(problems) == []
    assert plan is not None
    assert len(plan.processes) == count


@pytest.mark.parametrize(
    ("file", "word", "suggestion"),
    [
        ("bringup.launch.yaml", "paramsfile:=x", "params_file"),
        ("bringup.launch.yaml", "slm:=True", "slam"),
        ("fleet.launch.yaml", "rvizconfig:=x", "rviz_config"),
        ("fleet.launch.yaml", "colour:=red", None),
    ],
)
def test_a_misspelt_argument_is_refused_even_where_conditions_hide_a_part(
    file: str, word: str, suggestion: str | None
) -> None:
    problems = Problems()
    collect(str(_ORDINARY / file), inputs_from([word], environment=_ENVIRONMENT), problems)
    assert [(problem.code, problem.suggestion) for problem in problems.errors] == [
        (Code.UNKNOWN_ARGUMENT, suggestion)
    ]


def test_an_argument_that_only_a_hidden_part_reads_is_none_that_is_misspelt() -> None:
    """`config` is declared by a file that is included under a condition, which is false."""
    problems = Problems()
    given = inputs_from(["config:=x"], environment=_ENVIRONMENT)
    collect(str(_ORDINARY / "perception.launch.yaml"), given, problems)
    assert list(problems) == []
