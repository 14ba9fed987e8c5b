"""Files that a run is described by: robots with settings of their own, and scripts of commands."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from bringup.world.drive import STILL, Twist
from bringup.world.geometry import Pose
from bringup.world.layout import lay_out
from bringup.world.robots_file import read
from bringup.world.script import ScriptError, read_script
from bringup.world.settings import SettingsError, settings
from bringup.world.table import TABLE

if TYPE_CHECKING:
    from pathlib import Path

DEFAULTS: dict[str, Any] = {setting.name: setting.default for setting in TABLE}
ROBOTS = """
robots:
  one: {x: 1, y: -2.0, yaw: 0.5, wheel_slip: 0.02, max_linear_velocity: 1, encoder_counts: 4096, mode: wander}
  two:
  three: {x: -2.0, y: 2.0}
"""


def test_robots_of_a_file_have_start_poses_and_settings_of_their_own(tmp_path: Path) -> None:
    file = tmp_path / "robots.yaml"
    file.write_text(ROBOTS)
    made = settings({**DEFAULTS, "robots": ["other"]}, read(file))
    assert made.robots == ("one", "two", "three")
    assert made.start_poses == (Pose(1.0, -2.0, 0.5), None, Pose(-2.0, 2.0, 0.0))
    one, two, _ = made.each
    assert (one.wheels.slip, one.limits.linear_velocity, one.wheels.counts) == (0.02, 1.0, 4096)
    assert (two.wheels.slip, two.limits.linear_velocity, two.wheels.counts) == (0.01, 0.8, 0)


@pytest.mark.parametrize("seed", range(10))
def test_a_robot_without_a_start_pose_finds_room_beside_the_others(seed: int) -> None:
    poses = [Pose(1.0, -2.0, 0.5), None, Pose(-2.0, 2.0, 0.0), None]
    starts = [start.pose for start in lay_out("arena", seed, ["a", "b", "c", "d"], poses).starts]
    assert (starts[0], starts[2]) == (poses[0], poses[2])
    far = [abs(one.x - other.x) + abs(one.y - other.y) for one in starts for other in starts if one != other]
    assert min(far) > 1.0


def test_names_come_in_one_text_too() -> None:
    assert settings({**DEFAULTS, "robots": ["a, b,c"]}).robots == ("a", "b", "c")
    assert settings({**DEFAULTS, "robots": "a,b"}).robots == ("a", "b")


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("robots: {a: {wheel_slp: 0.1}}", "a: 'wheel_slp' is no setting; 'wheel_slip' is"),
        ("robots: {a: {wheel_slip: 0.9}}", "a: 'wheel_slip' is out of range: 0.9 is not from 0 to 0.5"),
        ("robots: {a: {wheel_slip: much}}", "a: 'wheel_slip' is no number: 'much'"),
        ("robots: {a: {encoder_counts: 1.5}}", "a: 'encoder_counts' is no whole number: 1.5"),
        ("robots: {a: {x: 1.0}}", "a: a start pose needs x and y"),
        ("robots: {a: {x: 1.0, y: no}}", "a: 'y' is no number: False"),
        ("robots: {a: 3}", "'a' should have settings: 3"),
        ("robots: [a, b]", "names no robots"),
        ("robot1: {}", "names no robots"),
        ("robots: {", "no YAML"),
        (None, "cannot be read"),
    ],
)
def test_a_file_of_robots_that_cannot_be_meant_is_refused(
    tmp_path: Path, text: str | None, reason: str
) -> None:
    file = tmp_path / "robots.yaml"
    if text is not None:
        file.write_text(text)
    with pytest.raises(SettingsError, match=reason) as refused:
        read(file)
    assert "\n" not in str(refused.value)


def test_a_script_says_what_each_robot_obeys_at_each_tick(tmp_path: Path) -> None:
    file = tmp_path / "drive.csv"
    file.write_text("time, robot, linear, angular\n0.1,a,0.4,0\n\n0.3,b,0.1,-1\n0.2,a,0,0.5\n")
    script = read_script(file, ["a", "b", "c"])
    assert [script.command("a", tick) for tick in (0, 9, 10, 19, 20, 999)] == [
        *(STILL, STILL),
        *(Twist(0.4, 0.0), Twist(0.4, 0.0)),
        *(Twist(0.0, 0.5), Twist(0.0, 0.5)),
    ]
    assert script.command("b", 30) == Twist(0.1, -1.0)
    assert script.command("c", 30) is None


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("time,robot,linear\n", ":1: the first line should be time,robot,linear,angular"),
        ("time,robot,linear,angular\n0,d,1,1\n", ":2: no robot is called 'd'; there are a, b"),
        ("time,robot,linear,angular\n0,a,1\n", ":2: 3 columns instead of 4"),
        ("time,robot,linear,angular\n0,a,1,1\n0,a,fast,1\n", ":3: could not convert"),
        ("time,robot,linear,angular\n-1,a,1,1\n", ":2: not a time and a velocity: -1,a,1,1"),
        ("time,robot,linear,angular\n0,a,nan,1\n", ":2: not a time and a velocity"),
        (None, "cannot be read"),
    ],
)
def test_a_script_that_cannot_be_meant_is_refused(tmp_path: Path, text: str | None, reason: str) -> None:
    file = tmp_path / "drive.csv"
    if text is not None:
        file.write_text(text)
    with pytest.raises(ScriptError, match=reason):
        read_script(file, ["a", "b"])
