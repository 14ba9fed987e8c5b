"""The running node is asked: services, run-time parameters, and what it says of contacts, joints and frames."""

from __future__ import annotations

import signal
import threading
import time
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, JointState, LaserScan
from std_msgs.msg import String, UInt32
from std_srvs.srv import SetBool, Trigger

from bringup.world.interfaces import Contacts, SetSpeed, Step, Teleport
from bringup.world.messages import ticks_of
from orchestra.ros.interfaces import tf_message_type
from tests.bringup.greeting import greeting

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from contextlib import AbstractContextManager

    Start = Callable[..., AbstractContextManager[Any]]
    Listen = Callable[[int], AbstractContextManager[Any]]

DOMAIN = 26
LATCHED = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
SERVICES = {"reset": Trigger, "pause": SetBool, "step": Step, "teleport": Teleport, "set_speed": SetSpeed}
SCRIPT = "time,robot,linear,angular\n0,a,0.3,0.0\n"


@dataclass
class Asked:
    """A paused simulation with the robots `a`, which a script drives ahead, and `b`, which nobody drives."""

    ears: Any
    clients: dict[str, Any]
    parameters: AsyncParameterClient
    run: Any

    def ask(self, service: str, **request: Any) -> Any:
        client = self.clients[service]
        return answer(client.call_async(SERVICES[service].Request(**request)))

    def set(self, name: str, value: Any) -> Any:
        return answer(self.parameters.set_parameters([Parameter(name, value=value)])).results[0]

    def wait(self, topic: str, tick: float) -> Any:
        """The message of a topic that is of this tick."""
        return self.ears.wait(
            topic, lambda messages: [one for one in messages if ticks_of(one.header.stamp) == tick]
        )

    def scan(self, robot: str) -> Any:
        """A scan of now; steps are taken until one is heard, for a best-effort message can be lost."""
        for _ in range(60):
            tick = ticks_of(self.ask("step", ticks=10).time)
            heard = self.ears.heard[f"/fleet/{robot}/scan"]
            with self.ears.fresh:
                if self.ears.fresh.wait_for(lambda: heard and ticks_of(heard[-1].header.stamp) == tick, 1.0):  # noqa: B023
                    return heard[-1]
        pytest.fail(f"no scan of {robot} in 60 steps")


def answer(future: Any) -> Any:
    """The result of a call, which the listener's own thread brings."""
    done = threading.Event()
    future.add_done_callback(lambda _future: done.set())
    assert done.wait(60.0)
    return future.result()


@pytest.fixture(scope="module")
def asked(start: Start, listen: Listen, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Asked]:
    script = tmp_path_factory.mktemp("run") / "ahead.csv"
    script.write_text(SCRIPT)
    arguments = (
        *("-r", "__ns:=/fleet", "-p", "robots:='a,b'", "-p", "paused:=true", "-p", f"script:={script}"),
        *(
            "-p",
            "start_poses:=[0, 0, 0, 0, 2, 0]",
            "-p",
            "world:=corridor",
            "-p",
            "seed:=4",
            "-p",
            "world_frame:=map",
        ),
        *("-p", "status_period:=1000", "-p", "b.lidar_dropout:=0.5"),
    )
    with listen(DOMAIN) as ears:
        for robot in "ab":
            ears.listen(Odometry, f"/fleet/{robot}/ground_truth")
            ears.listen(Imu, f"/fleet/{robot}/imu/data")
            ears.listen(LaserScan, f"/fleet/{robot}/scan", qos_profile_sensor_data)
            ears.listen(JointState, f"/fleet/{robot}/joint_states")
            ears.listen(UInt32, f"/fleet/{robot}/contacts", LATCHED)
            ears.listen(String, f"/fleet/{robot}/robot_description", LATCHED)
        ears.listen(Contacts, "/fleet/contacts", LATCHED)
        ears.listen(tf_message_type(), "/tf_static", LATCHED)
        ears.listen(Clock, "/clock")
        with start(DOMAIN, *arguments) as run:
            clients = {
                name: ears.node.create_client(kind, f"/fleet/simulation/{name}")
                for name, kind in SERVICES.items()
            }
            assert all(client.wait_for_service(60.0) for client in clients.values())
            parameters = AsyncParameterClient(ears.node, "/fleet/simulation")
            assert parameters.wait_for_services(60.0)
            for robot in "ab":
                ears.wait(f"/fleet/{robot}/robot_description", lambda messages: messages)
            _known(ears)
            _connected(ears, clients["step"])
            yield Asked(ears, clients, parameters, run)
            run.process.send_signal(signal.SIGINT)
            status, said = run.end()
            assert (status, "Traceback" in said) == (0, False)


def _known(ears: Any) -> None:
    """Wait until the simulation knows the clients: what it answers before is lost."""
    end = time.monotonic() + 60.0
    with greeting(ears.node, "/fleet/simulation") as known:
        while not known():
            assert time.monotonic() < end
            time.sleep(0.02)


def _connected(ears: Any, step: Any) -> None:
    """Take steps until something has been heard on every topic: publishers and listeners find one another in time."""
    topics = [
        f"/fleet/{robot}/{kind}"
        for robot in "ab"
        for kind in ("ground_truth", "imu/data", "joint_states", "scan")
    ]
    for _ in range(60):
        assert answer(step.call_async(Step.Request(ticks=10))).success
        with ears.fresh:
            if ears.fresh.wait_for(lambda: all(ears.heard[topic] for topic in topics), 1.0):
                return
    pytest.fail("not all topics are heard")


def _clock_says(asked: Asked, tick: int) -> None:
    """Wait until the clock that stands still has been heard."""
    asked.ears.wait("/clock", lambda heard: heard and ticks_of(heard[-1].clock) == tick)


@pytest.fixture
def fresh(asked: Asked) -> Asked:
    """The same simulation at time 0, paused, with nothing heard yet but what stays."""
    assert asked.ask("pause", data=True).success
    assert asked.ask("reset").success
    # What was said before comes before this.
    assert asked.ask("step", ticks=10).success
    for topic in ("ground_truth", "imu/data", "joint_states"):
        for robot in "ab":
            asked.ears.wait(
                f"/fleet/{robot}/{topic}", lambda heard: heard and ticks_of(heard[-1].header.stamp) == 10
            )
    _clock_says(asked, 10)
    assert asked.ask("reset").success
    _clock_says(asked, 0)
    for topic, messages in asked.ears.heard.items():
        if not topic.endswith(("robot_description", "tf_static")):
            messages.clear()
    return asked


def test_a_step_is_as_long_as_it_says(fresh: Asked) -> None:
    for ticks in (1, 49, 50):
        assert fresh.ask("step", ticks=ticks).success
    done = fresh.ask("step", ticks=20)
    assert (done.time.sec, done.time.nanosec) == (1, 200_000_000)
    # Time stands still, and its clock goes on saying so.
    clock = fresh.ears.heard["/clock"]
    fresh.ears.wait("/clock", lambda messages: [ticks_of(one.clock) for one in messages[-4:]] == [120.0] * 4)
    assert all(before <= after for before, after in pairwise(ticks_of(message.clock) for message in clock))
    assert not fresh.ask("step", ticks=0).success
    assert "1 to 1000000 ticks" in fresh.ask("step", ticks=0).message


def test_a_pause_ends_and_begins(fresh: Asked) -> None:
    assert fresh.ask("pause", data=False).success
    fresh.ears.wait("/clock", lambda messages: any(ticks_of(message.clock) > 20 for message in messages))
    assert fresh.ask("pause", data=True).success
    assert answer(fresh.parameters.get_parameters(["paused"])).values[0].bool_value is True


def test_two_runs_of_the_same_steps_are_the_same_to_the_last_bit(fresh: Asked) -> None:
    heard = []
    for _ in range(2):
        assert fresh.ask("reset").success
        assert fresh.ask("step", ticks=150).success
        topics = ("/fleet/a/ground_truth", "/fleet/a/imu/data")
        heard.append([fresh.wait(topic, 150) for topic in topics])
        for topic in topics:
            fresh.ears.heard[topic].clear()
    assert heard[0] == heard[1]
    assert heard[0][0].pose.pose.position.x > 0.2


def test_a_robot_is_put_elsewhere_if_there_is_room(fresh: Asked) -> None:
    assert fresh.ask("teleport", robot="b", x=0.0, y=-1.9, yaw=1.5).success
    assert fresh.ask("step", ticks=10).success
    truth = fresh.wait("/fleet/b/ground_truth", 10).pose.pose
    assert (truth.position.x, truth.position.y) == pytest.approx((0.0, -3.9), abs=1e-3)
    for where, reason in [
        ({"robot": "c", "x": 0.0, "y": 0.0}, "no robot is called 'c'; there are a, b"),
        ({"robot": "b", "x": 0.0, "y": 4.9}, "b has no room at x 0, y 4.9"),
        ({"robot": "b", "x": float("nan"), "y": 0.0}, "b has no room"),
        ({"robot": "b", "x": 0.1, "y": 0.0}, "a stands in the way"),
    ]:
        refused = fresh.ask("teleport", yaw=0.0, **where)
        assert not refused.success
        assert reason in refused.message


def test_what_a_robot_runs_into_is_told(fresh: Asked) -> None:
    assert fresh.ask("teleport", robot="a", x=4.4, y=0.0, yaw=0.0).success
    assert fresh.ask("step", ticks=200).success
    contacts = fresh.ears.wait(
        "/fleet/contacts", lambda messages: [each for message in messages for each in message.contacts]
    )
    assert (contacts.robot, contacts.other) == ("a", "wall_east")
    assert contacts.position.x == pytest.approx(5.0, abs=0.02)
    assert contacts.force > 1.0
    fresh.ears.wait("/fleet/a/contacts", lambda messages: [one for one in messages if one.data == 1])


def test_sensors_are_changed_while_they_run(fresh: Asked) -> None:
    assert 0.3 < np.isnan(fresh.scan("b").ranges).mean() < 0.7
    assert not np.isnan(fresh.scan("a").ranges).any()
    for name, value in [
        ("lidar_dropout", 1.0),
        ("b.lidar_dropout", 0),
        ("lidar_range_max", 2.0),
        ("imu_rate", 10),
    ]:
        assert fresh.set(name, value).successful
    changed = ticks_of(fresh.ask("step", ticks=10).time)
    assert np.isnan(fresh.scan("a").ranges).all()
    message = fresh.scan("b")
    scan = np.array(message.ranges)
    assert scan[np.isfinite(scan)].max() <= message.range_max == 2.0
    last = ticks_of(fresh.ask("step", ticks=10).time)
    fresh.wait("/fleet/a/imu/data", last)
    stamps = [ticks_of(one.header.stamp) for one in fresh.ears.heard["/fleet/a/imu/data"]]
    assert [stamp for stamp in stamps if stamp > changed] == list(range(int(changed) + 10, int(last) + 1, 10))
    for name, value in [
        ("lidar_dropout", 0.0),
        ("b.lidar_dropout", 0.5),
        ("lidar_range_max", 12.0),
        ("imu_rate", 100.0),
    ]:
        assert fresh.set(name, value).successful


@pytest.mark.parametrize(
    ("name", "value", "reason"),
    [
        ("gyro_noise", 2.0, "out of range"),
        ("lidar_range_min", 5.0, ""),
        ("lidar_range_max", 0.11, "lidar_range_min 0.12 is not below lidar_range_max 0.11"),
        ("a.gyro_noise", 2.0, "a: 'gyro_noise' is out of range: 2 is not from 0 to 1"),
        ("a.gyro_nose", 0.1, "no parameter is called 'a.gyro_nose'; 'a.gyro_noise' is"),
        ("c.gyro_noise", 0.1, "no robot is called 'c'"),
        ("gyro_nose", 0.1, "no parameter is called 'gyro_nose'; 'gyro_noise' is"),
        ("encoder_counts", 4096, ""),
        ("seed", 3, "read-only"),
    ],
)
def test_a_change_that_cannot_be_meant_is_refused_with_the_reason(
    asked: Asked, name: str, value: float, reason: str
) -> None:
    before = {"lidar_range_min": 0.12, "encoder_counts": 0}
    result = asked.set(name, value)
    assert result.successful is not bool(reason)
    assert reason in result.reason
    if not reason:
        assert asked.set(name, before[name]).successful


def test_speed_is_set_by_a_service(asked: Asked) -> None:
    refused = asked.ask("set_speed", speed=-1.0)
    assert (refused.success, "out of range" in refused.message) == (False, True)
    assert asked.ask("set_speed", speed=2.0).success
    assert answer(asked.parameters.get_parameters(["speed"])).values[0].double_value == 2.0


def test_joints_and_frames_are_those_of_the_description(fresh: Asked) -> None:
    fresh.ask("step", ticks=30)
    joints = fresh.wait("/fleet/a/joint_states", 30)
    robot = ET.fromstring(fresh.ears.heard["/fleet/a/robot_description"][-1].data)  # noqa: S314 - our own
    turning = {joint.get("name") for joint in robot.findall("joint") if joint.get("type") == "continuous"}
    assert set(joints.name) == turning == {"a/left_wheel_joint", "a/right_wheel_joint"}
    assert min(joints.position) > 0.0
    assert min(joints.velocity) > 0.5
    transforms = [one for message in fresh.ears.heard["/tf_static"] for one in message.transforms]
    parents = {one.child_frame_id: one.header.frame_id for one in transforms}
    links = {link.get("name") for link in robot.findall("link")}
    fixed = {frame for frame in parents if frame.startswith("a/") and frame != "a/odom"}
    assert fixed | {"a/base_footprint", "a/camera_link", "a/camera_optical_frame"} == links
    assert (parents["a/odom"], parents["b/odom"]) == ("map", "map")
    places = {one.child_frame_id: one.transform.translation for one in transforms}
    assert (places["b/odom"].x, places["b/odom"].y) == (0.0, 2.0)
