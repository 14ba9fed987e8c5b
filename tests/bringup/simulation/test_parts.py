"""The small pure parts: inertial noise, pace, tracks, settings and the lines of the report."""

import json
import math
import threading
from concurrent.futures import CancelledError, Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

import bringup
from bringup.world import report
from bringup.world.drive import STILL
from bringup.world.geometry import Pose
from bringup.world.inertial import Inertial, InertialNoise, variance
from bringup.world.layout import WORLDS, lay_out
from bringup.world.model import load
from bringup.world.orders import Orders
from bringup.world.pace import CATCH_UP, LARGEST_LAG, TICK, Metronome, Pace, kept, wait
from bringup.world.settings import TABLE, RobotSettings, SettingsError, settings
from bringup.world.simulation import Simulation
from bringup.world.track import MOST_POINTS, Recent, Trail

DEFAULTS = {setting.name: setting.default for setting in TABLE}


def test_the_imu_errs_as_its_variances_say() -> None:
    imu = Inertial(InertialNoise(0.005, 0.003, 0.1, -0.05), np.random.default_rng(2))
    true = np.array([0.1, -0.2, 0.7, 0.0, 1.0, 9.81])
    offs = np.array([imu.measure(true) for _ in range(5000)]) - true
    assert offs[:, :3].mean() == pytest.approx(0.003, abs=2e-4)
    assert offs[:, 3:].mean() == pytest.approx(-0.05, abs=4e-3)
    assert np.mean(offs[:, :3] ** 2) == pytest.approx(variance(0.005, 0.003), rel=0.05)
    assert np.mean(offs[:, 3:] ** 2) == pytest.approx(variance(0.1, -0.05), rel=0.05)


def test_an_exact_sensor_is_not_marked_as_unknown() -> None:
    assert variance(0.0, 0.0) > 0.0


def test_gravity_pushes_a_standing_robot_upwards() -> None:
    """REP 145: an accelerometer at rest shows the support's push, not the pull."""
    simulation = Simulation(load(lay_out("arena", 1, ["robot1"])))
    for _ in range(100):
        simulation.tick([STILL])
    robot = simulation.model.robots[0]
    standing = [0.0, 0.0, 0.0, 0.0, 0.0, 9.81]
    assert simulation.data.sensordata[robot.imu] == pytest.approx(standing, abs=0.02)


def test_ticks_are_due_at_the_speed_that_is_asked_for() -> None:
    assert wait(Pace(100.0, 0.0, 1.0), 100.0, 0.01) == pytest.approx(0.01)
    assert wait(Pace(100.0, 0.0, 2.0), 100.0, 0.01) == pytest.approx(0.005)
    assert wait(Pace(100.0, 5.0, 1.0), 103.0, 7.0) == pytest.approx(-1.0)
    assert wait(Pace(100.0, 0.0, 0.0), 100.0, 50.0) == 0.0


def test_a_small_lag_is_made_up_for_and_a_large_one_is_not() -> None:
    pace = Pace(100.0, 0.0, 1.0)
    assert kept(pace, 105.0, 5.0 - LARGEST_LAG / 2, 1.0) is pace
    late = kept(pace, 105.0, 5.0 - 2 * LARGEST_LAG, 1.0)
    assert wait(late, 105.0, 5.0 - 2 * LARGEST_LAG) == pytest.approx(0.0)


def test_a_new_speed_holds_from_now_on() -> None:
    pace = kept(Pace(100.0, 0.0, 1.0), 110.0, 10.0, 4.0)
    assert wait(pace, 110.0, 14.0) == pytest.approx(1.0)


def ticked(metronome: Metronome, now: float, time: float, until: float) -> tuple[float, float]:
    """Real and simulated time after all ticks that are due until then."""
    while True:
        rest = metronome.wait(now, time, 1.0)
        if now + max(rest, 0.0) > until:
            return now, time
        now += max(rest, 0.0)
        metronome.ticked(now)
        time += TICK


def test_a_late_tick_loses_no_simulated_time_and_makes_no_burst() -> None:
    metronome = Metronome(100.0, 1.0)
    _, time = ticked(metronome, 100.0, 0.0, 101.0)
    assert time == pytest.approx(1.0, abs=0.02)
    # Nothing has happened for 3 s: after one more it has not caught up, after as long again it has.
    _, behind = ticked(metronome, 104.0, time, 105.0)
    assert behind - time == pytest.approx(CATCH_UP, abs=0.05)
    assert metronome.lag == pytest.approx(2.0, abs=0.05)
    _, caught = ticked(metronome, 105.0, behind, 110.0)
    assert caught == pytest.approx(10.0, abs=0.02)
    assert metronome.lost == 0.0


def test_what_is_given_up_is_told() -> None:
    metronome = Metronome(100.0, 1.0)
    metronome.wait(100.0 + 3 * LARGEST_LAG, 0.0, 1.0)
    assert metronome.lost == pytest.approx(3 * LARGEST_LAG, abs=0.02)
    assert metronome.lag == pytest.approx(0.0, abs=0.02)
    assert report.behind(0.5, 1.0, 2.25, 30.0) == (
        "behind real time: factor 0.500 instead of 1, 2.2 s late, 30.0 s given up before"
    )


def test_time_that_stands_still_or_begins_anew_is_not_made_up_for() -> None:
    metronome = Metronome(100.0, 1.0)
    metronome.hold(105.0, 2.0)
    assert metronome.wait(105.0, 2.0, 1.0) == pytest.approx(TICK)
    # After a reset.
    assert metronome.wait(106.0, 0.0, 1.0) == pytest.approx(TICK)


def test_orders_are_carried_out_in_turn_and_answered() -> None:
    orders, done = Orders(), []

    def order(future: Future[int]) -> None:
        done.append(1)
        future.set_result(len(done))

    with ThreadPoolExecutor(1) as other:
        result = other.submit(orders.ask, order)
        orders.leave(lambda: done.append(0))
        while not result.done():
            orders.carry_out()
        assert result.result() == done.index(1) + 1
    assert sorted(done) == [0, 1]


def test_nobody_waits_for_a_run_that_is_over() -> None:
    orders = Orders()
    asked = threading.Event()
    with ThreadPoolExecutor(1) as other:
        result = other.submit(orders.ask, lambda _future: asked.set())
        while not asked.is_set():
            orders.carry_out()
        orders.close()
        with pytest.raises(CancelledError):
            result.result(60.0)
    with pytest.raises(CancelledError):
        orders.ask(lambda _future: None)


def test_the_schema_says_what_the_table_says() -> None:
    path = Path(bringup.__file__).parent / "params" / "simulation.schema.json"
    told = json.loads(path.read_text())["properties"]
    assert list(told) == sorted(DEFAULTS)
    for setting in TABLE:
        one = told[setting.name]
        assert one["description"] == setting.description
        assert one.get("readOnly", False) is not setting.changeable
        if isinstance(setting.default, tuple):
            assert one.get("default", []) == list(setting.default)
        else:
            assert one["default"] == setting.default
        if isinstance(setting.default, int | float) and not isinstance(setting.default, bool):
            assert (one["minimum"], one["maximum"]) == (setting.low, setting.high)
    assert told["world"]["enum"] == list(WORLDS)


def test_recent_poses_are_found_by_tick_and_between_ticks() -> None:
    recent: Recent[float] = Recent(ticks=3, read=lambda x: Pose(x, 0.0, 0.0))
    for tick in range(6):
        recent.add(float(tick))
    assert recent.at(4) == Pose(4.0, 0.0, 0.0)
    assert recent.at(3.25) == Pose(3.25, 0.0, 0.0)
    assert recent.at(2) is None
    assert recent.at(5.5) is None


def test_a_trail_of_any_length_keeps_its_shape_in_bounded_memory() -> None:
    trail = Trail()
    for step in range(5 * MOST_POINTS):
        trail.add(float(step), -float(step))
    assert len(trail.points) <= MOST_POINTS
    gaps = np.diff([x for x, _ in trail.points])
    assert trail.points[0] == (0.0, 0.0)
    assert set(gaps) == {gaps[0]}
    assert trail.points[-1][0] > 5 * MOST_POINTS - 2 * gaps[0]


def test_a_trail_leaves_out_what_is_no_place() -> None:
    trail = Trail()
    trail.add(math.nan, 0.0)
    trail.add(0.0, math.inf)
    assert trail.points == []


def test_the_defaults_go_together() -> None:
    made = settings(DEFAULTS)
    assert made.robots == ("robot1", "robot2")
    assert made.start_poses == ()
    assert made.each == (RobotSettings(), RobotSettings())


def test_every_default_is_within_its_range() -> None:
    for setting in TABLE:
        if isinstance(setting.default, int | float):
            assert setting.low <= setting.default <= setting.high
            assert isinstance(setting.default, bool) or math.isfinite(setting.high)
        assert setting.description.endswith(".")


def test_the_parameter_file_knows_only_settings_and_says_their_defaults() -> None:
    """A node ignores what it does not declare, so a misspelt line would go unnoticed."""
    path = Path(bringup.__file__).parent / "params" / "simulation.yaml"
    told = yaml.safe_load(path.read_text())["/**/simulation"]["ros__parameters"]
    defaults = {name: list(value) if isinstance(value, tuple) else value for name, value in DEFAULTS.items()}
    assert told == {name: defaults[name] for name in told}


def test_start_poses_come_as_triples() -> None:
    made = settings(DEFAULTS | {"start_poses": [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]})
    assert made.start_poses == (Pose(1.0, 2.0, 3.0), Pose(4.0, 5.0, 6.0))


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"robots": []}, "names no robot"),
        ({"robots": None}, "names no robot"),
        ({"robots": ["a", "a"]}, "'a' stands there twice"),
        ({"robots": ["1a"]}, "'1a' cannot be a namespace"),
        ({"robots": ["a__b"]}, "'a__b' cannot be a namespace"),
        ({"robots": ["a/b"]}, "'a/b' cannot be a namespace"),
        ({"start_poses": [1.0, 2.0]}, "2 numbers are no triples"),
    ],
)
def test_values_that_cannot_be_meant_are_refused(change: dict[str, Any], reason: str) -> None:
    with pytest.raises(SettingsError, match=reason):
        settings(DEFAULTS | change)


def test_the_lines_of_the_report() -> None:
    assert report.status("a", Pose(1.0, -2.0, -0.0), "no estimate yet", 0.5) == (
        "a: pose x 1.00 m, y -2.00 m, yaw 0.00 rad; filter no estimate yet; nearest obstacle 0.50 m"
    )
    assert report.filter_error(0.0123, 0.0456, age_ticks=4) == "error 0.012 m, 0.046 rad"
    assert report.filter_error(0.0123, 0.0456, age_ticks=250) == "error 0.012 m, 0.046 rad (2.5 s ago)"
    assert report.summary(9.5, 10.0) == "simulated 9.50 s in 10.00 s: real-time factor 0.950"
    assert report.summary(0.0, 0.0).endswith("factor 0.000")
    assert [report.contacts("a", count) for count in (0, 1, 2)] == [
        "a: 0 contacts",
        "a: 1 contact",
        "a: 2 contacts",
    ]
