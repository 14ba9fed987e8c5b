"""Who is there, and how they are."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from bringup.fleet.discovery import Presence, inside, part_of_status, robots
from bringup.fleet.frames import Frames, Place
from bringup.fleet.robots import Complaint, Health, Limits, Motion, Robot, health, looked
from bringup.fleet.settings import table

_SCHEMA = Path(__file__).parents[3] / "bringup" / "params" / "fleet_monitor.schema.json"
_SECOND = 1_000_000_000
_ENDING, _CONTROLLER = "odometry/filtered", "velocity_controller"
_LIMITS = Limits(stale_after=1.0)
_HERE = Presence(filtered=True, driven=True)


def test_a_robot_is_a_namespace_with_an_estimate_or_a_controller() -> None:
    topics = ["/robot1/odometry/filtered", "/site/robot2/odometry/filtered", "/odometry/filtered"]
    others = ["/robot9/odometry/filtered/more", "/robot8/wheel/odometry", "/robot7_odometry/filtered"]
    nodes = [("velocity_controller", "/robot3"), ("ekf", "/robot4"), ("velocity_controller", "/robot1")]
    found = robots(topics + others, nodes, _ENDING, _CONTROLLER)
    assert found == {
        "/": Presence(filtered=True),
        "robot1": Presence(filtered=True, driven=True),
        "robot3": Presence(driven=True),
        "site/robot2": Presence(filtered=True),
    }
    assert inside("/", "scan") == "/scan"
    assert inside("site/robot2", "scan") == "/site/robot2/scan"


def test_robots_come_and_go_but_not_for_a_moment() -> None:
    first = looked({}, {"a": _HERE, "b": _HERE}, 0, gone_after=3.0)
    assert (first.come, first.gone) == (("a", "b"), ())
    missed = looked(first.robots, {"a": _HERE}, _SECOND, gone_after=3.0)
    assert (missed.come, missed.gone) == ((), ())
    assert health(missed.robots["b"], 0, 0, _LIMITS)[0] is Health.STALE
    back = looked(missed.robots, {"a": _HERE, "b": _HERE}, 3 * _SECOND, gone_after=3.0)
    assert back.robots["b"].missed is None
    gone = looked(missed.robots, {"a": _HERE}, 4 * _SECOND, gone_after=3.0)
    assert (gone.come, gone.gone, set(gone.robots)) == ((), ("b",), {"a"})


def _robot(made: int | None = 0, presence: Presence = _HERE, **told: Complaint) -> Robot:
    motion = None if made is None else Motion(made, Place("robot1/odom", 0.0, 0.0), 0.0, 0.0)
    return Robot("robot1", presence, motion=motion, told=told)


@pytest.mark.parametrize(
    ("robot", "level", "reasons"),
    [
        (_robot(made=9 * _SECOND), Health.OK, ()),
        (_robot(made=None), Health.STALE, ("no odometry has come",)),
        (_robot(made=7 * _SECOND), Health.STALE, ("no odometry for 3.0 s",)),
        (_robot(9 * _SECOND, Presence(filtered=True)), Health.WARN, ("no controller",)),
        (_robot(9 * _SECOND, ekf=Complaint(Health.ERROR, "bad", 0)), Health.ERROR, ("ekf: bad",)),
        (_robot(9 * _SECOND, ekf=Complaint(Health.OK, "good", 0)), Health.OK, ()),
    ],
)
def test_health_is_the_worst_that_is_known(robot: Robot, level: Health, reasons: tuple[str, ...]) -> None:
    assert health(robot, 10 * _SECOND, _SECOND, _LIMITS) == (level, reasons)


def test_what_diagnostics_said_is_forgotten_with_who_said_it() -> None:
    robot = _robot(made=9 * _SECOND, ekf=Complaint(Health.ERROR, "bad", 0))
    assert health(robot, 10 * _SECOND, 6 * _SECOND, _LIMITS) == (Health.OK, ())


def test_a_clock_that_was_set_back_makes_no_odometry_old() -> None:
    assert _robot(made=20 * _SECOND).age(_SECOND) == 0.0


def test_a_status_is_about_a_robot_that_it_names() -> None:
    known = ["robot1", "site/robot2"]
    assert part_of_status("/robot1/ekf: filter", "none", known) == ("robot1", "ekf: filter")
    assert part_of_status("site/robot2/ekf", "", known) == ("site/robot2", "ekf")
    assert part_of_status("ekf: filter", "robot1", known) == ("robot1", "ekf: filter")
    assert part_of_status("/robot11/ekf", "", known) is None
    assert part_of_status("fleet_monitor: robot1", "fleet", known) is None


def test_places_are_seen_from_the_outermost_frame() -> None:
    frames = Frames()
    frames.put("robot1/odom", Place("world", 1.0, 2.0, math.pi / 2))
    frames.put("robot1/map", Place("robot1/odom", 1.0, 0.0))
    place = frames.rooted(Place("robot1/map", 1.0, 0.0, math.pi))
    assert place.frame == "world"
    assert (place.x, place.y, place.yaw) == pytest.approx((1.0, 4.0, -math.pi / 2))
    assert frames.rooted(Place("nowhere", 1.0, 2.0)) == Place("nowhere", 1.0, 2.0)


def test_frames_that_stand_in_themselves_end_nothing() -> None:
    frames = Frames()
    frames.put("a", Place("b", 1.0, 0.0))
    frames.put("b", Place("a", 1.0, 0.0))
    assert frames.rooted(Place("a", 1.0, 0.0)) == Place("a", 1.0, 0.0)


def test_the_schema_says_of_each_parameter_what_the_node_says() -> None:
    written = json.loads(_SCHEMA.read_text("utf-8"))["properties"]
    assert set(written) == {each.name for each in table()}
    for each in table():
        said = written[each.name]
        assert (said["description"], said["default"]) == (each.description, each.default)
        assert (said.get("minimum"), said.get("maximum")) == (each.minimum, each.maximum)
        assert said.get("readOnly", False) == each.fixed
