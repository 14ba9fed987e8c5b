"""Parameters: what is declared, and which sets of values are refused and why."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

import bringup
from bringup.control.modes import Mode, following
from bringup.control.settings import Settings, objection, table


def test_the_defaults_can_be_used() -> None:
    assert objection(Settings()) is None


def test_every_parameter_is_described_and_every_number_has_a_range_around_its_default() -> None:
    for each in table():
        assert each.description
        if isinstance(each.default, str):
            assert each.constraints
        elif not isinstance(each.default, bool):
            assert each.minimum is not None
            assert each.maximum is not None
            assert each.minimum <= each.default <= each.maximum


@pytest.mark.parametrize(
    ("values", "reason"),
    [
        ({"mode": "fly"}, "mode is 'fly', must be one of linear, rotational, wander, hold, go_to_goal"),
        ({"max_linear_vel": 0.9}, "max_linear_vel is 0.9, must lie in 0.0 .. 0.8"),
        ({"max_angular_vel": -0.1}, "max_angular_vel is -0.1, must lie in 0.0 .. 1.5"),
        ({"scan_timeout": float("nan")}, "scan_timeout is nan, must lie in 0.15 .. 5.0"),
        ({"obstacle_distance": 0.25}, "obstacle_distance (0.25 m) must exceed robot_radius (0.25 m)"),
        ({"robot_radius": 0.6}, "obstacle_distance (0.5 m) must exceed robot_radius (0.6 m)"),
        ({"seed": -1}, "seed is -1, must lie in 0 .. 2147483647"),
        ({"robot_radius": 0.6, "obstacle_distance": 0.9}, None),
        ({"max_linear_vel": 0.0, "max_angular_vel": 1.5, "mode": "hold"}, None),
    ],
)
def test_a_set_of_values_is_refused_with_its_reason(values: dict[str, Any], reason: str | None) -> None:
    assert objection(replace(Settings(), **values)) == reason


def test_the_parameter_file_of_the_bringup_names_every_parameter_and_can_be_used() -> None:
    package = Path(bringup.__file__).parent
    text = (package / "params" / "velocity_controller.yaml").read_text()
    values = yaml.safe_load(text)["/**/velocity_controller"]["ros__parameters"]
    assert list(values) == [each.name for each in table()]
    assert objection(Settings(**values)) is None


def test_the_schema_of_the_managed_controller_says_the_same_as_the_other_one() -> None:
    folder = Path(bringup.__file__).parent / "params"
    plain, managed = (
        json.loads((folder / f"{name}.schema.json").read_text())
        for name in ("velocity_controller", "velocity_controller_lifecycle")
    )
    assert managed["properties"] == plain["properties"]
    assert list(plain["properties"]) == sorted(each.name for each in table())
    assert plain["properties"]["mode"]["enum"] == list(Mode)


@given(distance=st.floats(0.1, 5.0), radius=st.floats(0.05, 1.0))
def test_the_robot_never_stops_inside_its_own_circle(distance: float, radius: float) -> None:
    accepted = objection(Settings(obstacle_distance=distance, robot_radius=radius)) is None
    assert accepted == (distance > radius)


def test_switching_goes_through_all_modes_and_round() -> None:
    mode, seen = Mode.LINEAR, []
    for _ in range(4):
        mode = following(mode)
        seen.append(mode)
    assert seen == [Mode.ROTATIONAL, Mode.WANDER, Mode.HOLD, Mode.LINEAR]


def test_switching_leaves_going_to_a_goal_and_never_comes_to_it() -> None:
    assert following(Mode.GO_TO_GOAL) is Mode.LINEAR
