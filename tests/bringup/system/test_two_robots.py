"""The two robots, launched for real and heard by a separate ROS program."""

from __future__ import annotations

import json
import math
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.testing.run import Run

pytest.importorskip("rclpy", reason="needs ROS")
pytest.importorskip("mujoco", reason="needs the bringup")

TWO_ROBOTS = str(Path(__file__).parents[3] / "bringup" / "two_robots.yaml")
RATES = {"scan": 10, "imu/data": 100, "wheel/odometry": 50, "odometry/filtered": 50, "ground_truth": 50}


def _listen(run: Run, seconds: float) -> dict[str, Any]:
    """Return what a program of its own hears of the run."""
    environment = {
        **os.environ,
        "ROS_DOMAIN_ID": str(run.domain),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }
    listener = Path(__file__).with_name("listener.py")
    done = subprocess.run(
        [sys.executable, str(listener), str(seconds)],
        env=environment,
        stdout=subprocess.PIPE,
        timeout=150,
        check=True,
    )
    report: dict[str, Any] = json.loads(done.stdout)
    return report


@pytest.mark.timeout(300)
def test_two_robots_drive_and_are_heard(launch: Callable[..., Run]) -> None:
    """Types, frames and rates of everything; the filter is near the truth and nearer than the wheels."""
    run = launch(TWO_ROBOTS)
    run.wait_ready(timeout=60)
    heard = _listen(run, 35)
    assert heard["rates"]["/clock"] == pytest.approx(100, rel=0.2)
    for robot in ("robot1", "robot2"):
        for topic, rate in RATES.items():
            assert heard["rates"][f"/{robot}/{topic}"] == pytest.approx(rate, rel=0.2), (robot, topic)
        assert heard["rates"][f"/tf {robot}/base_footprint"] == pytest.approx(50, rel=0.2)
        _check_frames(heard, robot)
        _check_poses(heard["poses"][robot])
    assert run.stop() == 130
    contacts = re.findall(r"(robot\d): (\d+) contacts", run.logs("simulation"))
    assert contacts == [("robot1", "0"), ("robot2", "0")]


def _check_frames(heard: dict[str, Any], robot: str) -> None:
    """The frames of a robot form one tree with `robotN/odom` at its root, and messages name frames of it."""
    odom, base = f"{robot}/odom", f"{robot}/base_footprint"
    transforms = heard["transforms"]
    assert transforms[base] == odom
    assert base in heard["moving"]
    for topic in ("wheel/odometry", "odometry/filtered", "ground_truth"):
        assert heard["frames"][f"/{robot}/{topic}"] == [odom, base]
    for topic in ("scan", "imu/data"):
        frame = heard["frames"][f"/{robot}/{topic}"][0]
        while frame in transforms:
            frame = transforms[frame]
        assert frame == odom


def _check_poses(poses: dict[str, tuple[float, float, float]]) -> None:
    truth, filtered, wheels = poses["ground_truth"], poses["odometry/filtered"], poses["wheel/odometry"]
    error = math.dist(truth[:2], filtered[:2])
    assert error < 0.3
    assert abs(math.remainder(truth[2] - filtered[2], 2 * math.pi)) < 0.1
    assert error < math.dist(truth[:2], wheels[:2])


@pytest.mark.timeout(180)
def test_a_run_of_a_given_length_ends_by_itself(launch: Callable[..., Run], tmp_path: Path) -> None:
    picture = tmp_path / "paths.png"
    run = launch(TWO_ROBOTS, "duration:=20", "world:=maze", f"picture:={picture}")
    assert run.wait(timeout=120) == 0
    log = run.logs("simulation")
    for robot in ("robot1", "robot2"):
        assert re.search(rf"{robot}: pose .*filter error .*nearest obstacle", log)
    assert picture.read_bytes().startswith(b"\x89PNG")


@pytest.mark.timeout(180)
def test_parameters_of_the_command_line_reach_the_running_nodes(
    launch: Callable[..., Run], tmp_path: Path
) -> None:
    """Asked over the nodes' own parameter services."""
    over = tmp_path / "over.yaml"
    over.write_text(
        "/**/velocity_controller:\n  ros__parameters:\n    obstacle_distance: 0.7\n    max_linear_vel: 0.2\n"
    )
    run = launch(
        *(
            TWO_ROBOTS,
            "mode:=hold",
            "/robot1/velocity_controller:max_linear_vel:=0.3",
            "--params-file",
            str(over),
        ),
    )
    run.wait_ready(timeout=60)
    asked = {
        "/robot1/velocity_controller": ["max_linear_vel", "obstacle_distance", "mode", "use_sim_time"],
        "/robot2/velocity_controller": ["max_linear_vel", "obstacle_distance"],
        "/robot1/ekf": ["odom_frame", "frequency"],
    }
    assert _parameters(run, asked) == {
        "/robot1/velocity_controller": [0.3, 0.7, "hold", True],
        "/robot2/velocity_controller": [0.2, 0.7],
        "/robot1/ekf": ["robot1/odom", 50.0],
    }


def _parameters(run: Run, asked: dict[str, list[str]]) -> dict[str, list[Any]]:
    environment = {
        **os.environ,
        "ROS_DOMAIN_ID": str(run.domain),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }
    done = subprocess.run(
        [sys.executable, str(Path(__file__).with_name("asker.py")), json.dumps(asked)],
        env=environment,
        stdout=subprocess.PIPE,
        timeout=120,
        check=True,
    )
    answers: dict[str, list[Any]] = json.loads(done.stdout)
    return answers
