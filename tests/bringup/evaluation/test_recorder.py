"""The recorder as a process: it finds robots, writes them down, and leaves a sound file however it ends."""

import math
import os
import signal
import subprocess
import sys
import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
import rclpy
from nav_msgs.msg import Odometry
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import UInt32

from bringup.evaluation.recording import CONTACTS, TRUTH, WHEELS, Recording, RecordingError, read
from bringup.evaluation.tracks import tracks
from orchestra.testing.domain import free_domain
from tests.killing import kill

PATIENCE = 60.0
STEP = 20_000_000
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
POSES = ("ground_truth", "wheel/odometry", "odometry/filtered")


@pytest.fixture(scope="module")
def domain() -> Iterator[int]:
    with free_domain(os.environ) as free:
        yield free


@pytest.fixture
def robot(domain: int) -> Iterator[Node]:
    context = Context()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        rclpy.init(context=context, domain_id=domain)
    with warnings.catch_warnings():
        # The first node of a process imports lark, which imports a module that Python deprecates.
        warnings.simplefilter("ignore", DeprecationWarning)
        node = rclpy.create_node("robot", context=context)
    yield node
    node.destroy_node()
    context.shutdown()


@contextmanager
def recorder(domain: int, file: Path, *parameters: str) -> Iterator["subprocess.Popen[str]"]:
    env = os.environ | {"ROS_DOMAIN_ID": str(domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    given = [word for name in (f"file:={file}", "simulation:=''", *parameters) for word in ("-p", name)]
    command = [sys.executable, "-m", "bringup.nodes.recorder", "--ros-args", *given]
    with subprocess.Popen(
        command, env=env, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    ) as process:
        try:
            yield process
        finally:
            if process.poll() is None:
                kill(process)


class Driver:
    """Publishes a robot's poses, 50 times in a second of its own time, as fast as they are asked for."""

    def __init__(self, node: Node) -> None:
        self._publishers = [node.create_publisher(Odometry, f"/r/{topic}", 50) for topic in POSES]
        self._contacts = node.create_publisher(UInt32, "/r/contacts", LATCHED)
        self.stamp = 0

    def drive(self, y: float) -> None:
        """One step along a line: the wheels are 1 m ahead of the truth, the filter 0.5 m."""
        self.stamp += STEP
        for ahead, publisher in zip((0.0, 1.0, 0.5), self._publishers, strict=True):
            message = Odometry()
            message.header.stamp.sec, message.header.stamp.nanosec = divmod(self.stamp, 10**9)
            message.pose.pose.position.x, message.pose.pose.position.y = self.stamp * 1e-9 + ahead, y
            message.pose.pose.orientation.z = math.sin(0.15)
            message.pose.pose.orientation.w = math.cos(0.15)
            message.pose.covariance[0::7] = 0.25
            message.pose.covariance[5] = message.pose.covariance[30] = 0.125
            publisher.publish(message)
        self._contacts.publish(UInt32(data=2))


def drive_until(driver: Driver, y: float, file: Path, done: Callable[[Recording], bool]) -> Recording:
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline:
        for _ in range(10):
            driver.drive(y)
        time.sleep(0.05)
        try:
            found = read(file)
        except (FileNotFoundError, RecordingError):
            continue
        if done(found):
            return found
    pytest.fail("the recorder has not written what was published")


def has_rows(y: float) -> Callable[[Recording], bool]:
    def enough(recording: Recording) -> bool:
        if not recording.facts.get("robots"):
            return False
        stamps, values = recording.of(TRUTH, 0)
        others = all(len(recording.of(kind, 0)[0]) > least for kind, least in ((WHEELS, 10), (CONTACTS, 0)))
        return others and len(stamps) > 100 and bool((values[:, 1] == y).all())

    return enough


def test_a_killed_recorder_leaves_all_but_its_last_second(domain: int, robot: Node, tmp_path: Path) -> None:
    file, driver = tmp_path / "run", Driver(robot)
    with recorder(domain, file) as process:
        drive_until(driver, 1.0, file, has_rows(1.0))
        # The simulation starts again: its clock goes back, and what was before does not count any more.
        driver.stamp = 0
        drive_until(driver, 2.0, file, has_rows(2.0))
        kill(process)
        process.wait()
    (track,) = tracks(read(file))
    assert track.robot == "r"
    assert track.contacts == 2
    assert track.truth[:, 0] == pytest.approx(track.times)
    assert track.wheels[:, 0] == pytest.approx(track.times + 1.0)
    assert track.filtered[:, 0] == pytest.approx(track.times + 0.5)
    assert track.filtered[:, 2] == pytest.approx(0.3)
    assert track.covariance[0].tolist() == [[0.25, 0.0, 0.125], [0.0, 0.25, 0.0], [0.125, 0.0, 0.25]]
    # Ten rows in a second of the filter and the wheels, all fifty of the truth.
    assert 0.05 < (track.times[-1] - track.times[0]) / (len(track.times) - 1) < 0.5


def test_a_signal_ends_it_well(domain: int, tmp_path: Path) -> None:
    with recorder(domain, tmp_path / "run", "robots:=[r]") as process:
        assert process.stdout is not None
        for line in process.stdout:
            if "hearing r" in line:
                break
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE) == 0
    assert read(tmp_path / "run").facts == {"robots": ["r"]}


def test_a_file_that_cannot_be_made_is_said(domain: int, tmp_path: Path) -> None:
    with recorder(domain, tmp_path / "missing" / "run") as process:
        said, _ = process.communicate(timeout=PATIENCE)
    assert process.returncode == 1
    assert "the recording cannot be written" in said
    assert "missing/run" in said
