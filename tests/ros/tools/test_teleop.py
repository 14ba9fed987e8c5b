"""Driving with the keys."""

from __future__ import annotations

import fcntl
import json
import os
import pty
import subprocess
import termios
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import pytest

pytest.importorskip("rclpy", reason="needs ROS")

from orchestra.ros.tools.driving import STOPPED, Driving
from orchestra.testing.domain import free_domain
from tests.ros.tools.conftest import Graph

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

_TWIST, _STAMPED = "geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped"


@pytest.fixture(scope="module")
def shell() -> Iterator[Graph]:
    """A domain with nobody in it."""
    with free_domain({}) as number:
        yield Graph(
            {
                **os.environ,
                "ROS_DOMAIN_ID": str(number),
                "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
                "NO_COLOR": "1",
            }
        )


def test_keys_are_directions_and_speeds() -> None:
    driving = Driving(0.5, 1.0, limits=(0.6, 9.0))
    assert driving.command == STOPPED
    assert driving.pressed("i").command == (0.5, 0, 0, 0)
    assert driving.pressed("left").command == (0, 0, 0, 1.0)
    assert driving.pressed(".").command == (-0.5, 0, 0, 1.0)
    assert driving.pressed("J").command == (0, 0.5, 0, 0)
    assert driving.pressed("i").pressed("w").command == pytest.approx((0.55, 0, 0, 0))
    assert driving.pressed("w").pressed("w").speed == 0.6
    assert driving.pressed("e").turn == pytest.approx(1.1)
    for key in (" ", "k", "escape", "\r", "ä"):
        assert driving.pressed("i").pressed(key).command == STOPPED


@contextmanager
def _heard(shell: Graph, topic: str, kind: str) -> Iterator[Callable[[Callable[[Any], bool]], Any]]:
    """Yield what waits for a command for which something holds."""
    words = ("topic", "echo", topic, kind, "--format", "json", "--qos-reliability", "reliable")
    with shell.asking(*words) as echo:
        _until_there(shell, topic)

        def wait(holds: Callable[[Any], bool]) -> Any:
            assert echo.stdout is not None
            for line in echo.stdout:
                if holds(found := json.loads(line)):
                    return found
            raise AssertionError("nothing more is heard")

        yield wait


def _until_there(shell: Graph, topic: str) -> None:
    """Wait until a command hears a topic; the time limit of the test ends it."""
    while topic not in shell.told("topic", "list").splitlines():
        pass


def _control(terminal: int) -> Callable[[], None]:
    """Return what makes a terminal the controlling one of a process that begins, so that Ctrl-C is a signal."""

    def take() -> None:
        os.setsid()
        fcntl.ioctl(terminal, termios.TIOCSCTTY, 0)

    return take


def test_keys_of_a_terminal_drive_and_ctrl_c_stops(shell: Graph) -> None:
    ours, theirs = pty.openpty()
    before = termios.tcgetattr(ours)
    with (
        _heard(shell, "/robot1/cmd_vel", _TWIST) as wait,
        subprocess.Popen(
            shell.command("teleop", "--namespace", "robot1", "--speed", "0.4"),
            env=shell.environment,
            stdin=theirs,
            stdout=subprocess.PIPE,
            text=True,
            preexec_fn=_control(theirs),  # noqa: PLW1509 - no thread runs in this process
        ) as teleop,
    ):
        assert teleop.stdout is not None
        while "geometry_msgs/msg/Twist on /robot1/cmd_vel" not in teleop.stdout.readline():
            assert teleop.poll() is None
        os.write(ours, b"i")
        assert wait(lambda twist: twist["linear"]["x"] > 0)["linear"]["x"] == 0.4
        os.write(ours, b"\x1b[D")
        turning = wait(lambda twist: twist["angular"]["z"] > 0)
        assert (turning["linear"]["x"], turning["angular"]["z"]) == (0, 1)
        os.write(ours, b"\x03")
        assert teleop.wait() == 130
        wait(lambda twist: twist["angular"]["z"] == 0)
    assert termios.tcgetattr(ours) == before
    os.close(ours)
    os.close(theirs)


def test_the_type_of_the_topic_is_taken_and_the_end_of_what_is_typed_stops(shell: Graph) -> None:
    with (
        _heard(shell, "/drive", _STAMPED) as wait,
        subprocess.Popen(
            shell.command("teleop", "--topic", "/drive", "--frame-id", "base", "--format", "json"),
            env=shell.environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            text=True,
        ) as teleop,
    ):
        assert teleop.stdin is not None
        teleop.stdin.write(",")
        teleop.stdin.flush()
        found = wait(lambda one: one["twist"]["linear"]["x"] < 0)
        assert found["header"]["frame_id"] == "base"
        assert found["header"]["stamp"]["sec"] > 0
        teleop.stdin.close()
        assert teleop.wait() == 0
        wait(lambda one: one["twist"]["linear"]["x"] == 0)


def test_who_presses_no_key_any_more_stops_where_that_is_asked_for(shell: Graph) -> None:
    with (
        _heard(shell, "/cmd_vel", _TWIST) as wait,
        subprocess.Popen(
            shell.command("teleop", "--key-timeout", "1.5"),
            env=shell.environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            text=True,
        ) as teleop,
    ):
        assert teleop.stdin is not None
        teleop.stdin.write("i")
        teleop.stdin.flush()
        wait(lambda twist: twist["linear"]["x"] == 0)
        assert teleop.poll() is None
        teleop.stdin.close()
        assert teleop.wait() == 0


def test_a_topic_of_another_type_is_not_driven_on(shell: Graph) -> None:
    with shell.asking("topic", "echo", "/text", "std_msgs/msg/String"):
        _until_there(shell, "/text")
        done = shell.ask("teleop", "--topic", "/text")
    assert (done.status, done.errors) == (
        1,
        "error: /text is of type std_msgs/msg/String, which no keys drive\n",
    )
