"""The real node, beside a real rclpy participant that plays its robot."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import AccelWithCovarianceStamped, TransformStamped
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters, SetParameters
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.signals import SignalHandlerOptions
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu
from std_srvs.srv import Empty

import bringup
from bringup.filter.settings import NANOSECONDS
from bringup.filter_node.ticks import next_tick
from bringup.filter_node.visits import VisitedSubscriptions
from orchestra.ros.interfaces import tf_message_type
from orchestra.ros.interfaces.definitions import provide
from tests.bringup.greeting import greeting
from tests.killing import let_nobody_hang

# lark, which the ROS wheels load, still imports a module that Python 3.11 has renamed.
pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")

DOMAIN = 38
DEADLINE = 40.0
PARAMETERS = Path(bringup.__file__).parent / "params" / "ekf.yaml"
Make = Callable[..., Any]


class Bench:
    """A participant with its own context; waits for conditions, never for a time."""

    def __init__(self) -> None:
        self.context = rclpy.Context()
        rclpy.init(context=self.context, domain_id=DOMAIN, signal_handler_options=SignalHandlerOptions.NO)
        self.node = rclpy.create_node("bench", context=self.context)
        self._executor = SingleThreadedExecutor(context=self.context)
        self._executor.add_node(self.node)

    def close(self) -> None:
        self._executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self.context)

    def until(self, condition: Callable[[], object], step: Callable[[], object] | None = None) -> None:
        """Spin, with a step in between, until the condition holds; fails at the deadline."""
        end = time.monotonic() + DEADLINE
        while not condition():
            assert time.monotonic() < end, "the condition did not come true in time"
            if step is not None:
                step()
            self._executor.spin_once(timeout_sec=0.005)

    def collect(self, kind: type, topic: str) -> list[Any]:
        received: list[Any] = []
        self.node.create_subscription(kind, topic, received.append, 50)
        return received

    def call(
        self,
        kind: Any,
        name: str,
        request: Any,
        step: Callable[[], object] | None = None,
        server: str = "/robot7/ekf",
    ) -> Any:
        client = self.node.create_client(kind, name)
        self.until(client.service_is_ready, step)
        with greeting(self.node, server) as known:
            self.until(known, step)
        answer = client.call_async(request)
        self.until(answer.done, step)
        self.node.destroy_client(client)
        return answer.result()

    def sees(self, name: str) -> bool:
        return name in {
            f"{space.rstrip('/')}/{node}" for node, space in self.node.get_node_names_and_namespaces()
        }


@pytest.fixture(scope="module")
def bench() -> Iterator[Bench]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        bench = Bench()
        yield bench
        bench.close()


class Ekf:
    """A running filter node with what it says on its standard error."""

    def __init__(self, log: Path, arguments: Sequence[str]) -> None:
        environment = {
            **os.environ,
            "ROS_DOMAIN_ID": str(DOMAIN),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "AMENT_PREFIX_PATH": os.environ.get("AMENT_PREFIX_PATH") or sys.prefix,
        }
        command = [sys.executable, "-m", "bringup.nodes.ekf", "--ros-args", *arguments]
        self._log = log
        with log.open("w") as output:
            self.process = subprocess.Popen(command, env=environment, stderr=output)

    @property
    def said(self) -> str:
        return self._log.read_text()

    def end(self, number: signal.Signals = signal.SIGTERM) -> int:
        self.process.send_signal(number)
        status = self.process.wait(DEADLINE)
        if status == -signal.SIGKILL:
            let_nobody_hang()
        return status


@pytest.fixture(scope="module")
def start(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[..., Ekf]]:
    """Start a node; whatever the tests have not ended is ended here, and must end well."""
    started: list[Ekf] = []

    def run(*arguments: str) -> Ekf:
        ekf = Ekf(tmp_path_factory.mktemp("ekf") / "log.txt", arguments)
        started.append(ekf)
        return ekf

    yield run
    statuses = [ekf.end() for ekf in started if ekf.process.poll() is None]
    assert set(statuses) <= {0}


def _parameters(**values: object) -> list[str]:
    return [word for name, value in values.items() for word in ("-p", f"{name}:={value}")]


class Robot:
    """Drives straight ahead at 1 m/s while it turns left at 0.2 rad/s, on its own simulated clock."""

    def __init__(self, bench: Bench, name: str) -> None:
        node = bench.node
        self.name = name
        self.now = 100 * NANOSECONDS
        self.place = (0.0, 0.0)
        self._clock = node.create_publisher(Clock, "/clock", 1)
        self._imu = node.create_publisher(Imu, f"/{name}/imu/data", 10)
        self._odometry = node.create_publisher(Odometry, f"/{name}/wheel/odometry", 10)
        static = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self._static = node.create_publisher(tf_message_type(), "/tf_static", static)
        self._static.publish(_transforms(f"{name}/base", f"{name}/imu", 0, 0.1))

    def step(self) -> None:
        """Let ten milliseconds pass."""
        self.now += NANOSECONDS // 100
        imu, odometry, clock = Imu(), Odometry(), Clock()
        for stamp in (imu.header.stamp, odometry.header.stamp, clock.clock):
            stamp.sec, stamp.nanosec = divmod(self.now, NANOSECONDS)
        imu.header.frame_id = f"{self.name}/imu"
        imu.angular_velocity.z = 0.2
        imu.angular_velocity_covariance[[0, 4, 8]] = 1e-6
        odometry.header.frame_id = f"{self.name}/odom"
        odometry.child_frame_id = f"{self.name}/base"
        odometry.pose.pose.position.x, odometry.pose.pose.position.y = self.place
        odometry.twist.twist.linear.x = 1.0
        odometry.twist.covariance = (np.eye(6) * 1e-4).reshape(-1)
        self._imu.publish(imu)
        self._odometry.publish(odometry)
        self._clock.publish(clock)


def _transforms(parent: str, child: str, stamp: int, x: float) -> Any:
    stamped = TransformStamped()
    stamped.header.stamp.sec, stamped.header.stamp.nanosec = divmod(stamp, NANOSECONDS)
    stamped.header.frame_id, stamped.child_frame_id = parent, child
    stamped.transform.translation.x = x
    stamped.transform.rotation.w = 1.0
    message = tf_message_type()()
    message.transforms = [stamped]
    return message


def _stamp(message: Any) -> int:
    return int(message.header.stamp.sec) * NANOSECONDS + int(message.header.stamp.nanosec)


@pytest.fixture(scope="module")
def robot(bench: Bench) -> Robot:
    return Robot(bench, "robot7")


@pytest.fixture(scope="module")
def ekf(start: Callable[..., Ekf], bench: Bench, robot: Robot) -> Ekf:
    """The node as the bringup starts it: shipped parameters, frames and clock given beside them."""
    frames = {f"{name}_frame": f"robot7/{value}" for name, value in (("odom", "odom"), ("world", "odom"))}
    arguments = _parameters(**frames, base_link_frame="robot7/base", use_sim_time="true")
    ekf = start("-r", "__ns:=/robot7", "--params-file", str(PARAMETERS), *arguments)
    received = bench.collect(Odometry, "/robot7/odometry/filtered")
    bench.until(lambda: received, robot.step)
    return ekf


@pytest.fixture
def filtered(bench: Bench, ekf: Ekf) -> list[Any]:
    assert ekf.process.poll() is None, ekf.said
    return bench.collect(Odometry, "/robot7/odometry/filtered")


def test_estimates_come_at_the_frequency_in_simulated_time(
    bench: Bench, robot: Robot, filtered: list[Any]
) -> None:
    stepped = time.monotonic()

    def step_once_it_has_kept_up() -> None:
        """A clock faster than the machine says nothing about the rate; a lost message must not stop it for ever."""
        nonlocal stepped
        behind = robot.now - _stamp(filtered[-1]) if filtered else 0
        if behind < NANOSECONDS // 50 or time.monotonic() - stepped > 0.5:
            robot.step()
            stepped = time.monotonic()

    bench.until(lambda: len(filtered) >= 20, step_once_it_has_kept_up)
    stamps = np.array([_stamp(message) for message in filtered])
    assert np.median(np.diff(stamps)) == pytest.approx(NANOSECONDS / 50, rel=0.2)
    message = filtered[-1]
    assert (message.header.frame_id, message.child_frame_id) == ("robot7/odom", "robot7/base")
    assert message.twist.twist.linear.x == pytest.approx(1.0, abs=0.01)
    assert message.twist.twist.angular.z == pytest.approx(0.2, abs=0.01)
    assert message.pose.pose.position.z == pytest.approx(0.0, abs=1e-6)


def test_the_transform_says_what_the_odometry_says(bench: Bench, robot: Robot, filtered: list[Any]) -> None:
    transforms = bench.collect(tf_message_type(), "/tf")

    def pairs() -> list[tuple[Any, Any]]:
        by_stamp = {_stamp(message): message for message in filtered}
        broadcast = [stamped for message in transforms for stamped in message.transforms]
        return [(stamped, by_stamp[_stamp(stamped)]) for stamped in broadcast if _stamp(stamped) in by_stamp]

    bench.until(pairs, robot.step)
    stamped, odometry = pairs()[-1]
    assert (stamped.header.frame_id, stamped.child_frame_id) == ("robot7/odom", "robot7/base")
    assert stamped.transform.translation.x == pytest.approx(odometry.pose.pose.position.x)
    assert stamped.transform.rotation.z == pytest.approx(odometry.pose.pose.orientation.z)


def test_set_pose_moves_the_estimate(bench: Bench, robot: Robot, filtered: list[Any], pose: Make) -> None:
    topic = bench.node.create_publisher(type(pose(0, (0.0,) * 6)), "/robot7/set_pose", 10)
    bench.until(topic.get_subscription_count, robot.step)
    topic.publish(pose(robot.now, (500.0, 0.0, 0.0, 0.0, 0.0, 0.0), frame="robot7/odom"))
    bench.until(lambda: filtered and filtered[-1].pose.pose.position.x > 450.0, robot.step)


def test_reset_starts_from_zero(bench: Bench, robot: Robot, filtered: list[Any], pose: Make) -> None:
    topic = bench.node.create_publisher(type(pose(0, (0.0,) * 6)), "/robot7/set_pose", 10)
    bench.until(topic.get_subscription_count, robot.step)
    topic.publish(pose(robot.now, (0.0, 500.0, 0.0, 0.0, 0.0, 0.0), frame="robot7/odom"))
    bench.until(lambda: filtered and filtered[-1].pose.pose.position.y > 450.0, robot.step)
    bench.call(Empty, "/robot7/reset", Empty.Request(), robot.step)
    bench.until(lambda: abs(filtered[-1].pose.pose.position.y) < 50.0, robot.step)


def test_set_pose_is_a_service_too(bench: Bench, robot: Robot, filtered: list[Any], pose: Make) -> None:
    provide("robot_localization")
    kind = import_module("robot_localization.srv").SetPose
    request = kind.Request(pose=pose(robot.now, (0.0, -500.0, 0.0, 0.0, 0.0, 0.0), frame="robot7/odom"))
    bench.call(kind, "/robot7/set_pose", request, robot.step)
    bench.until(lambda: filtered and filtered[-1].pose.pose.position.y < -450.0, robot.step)


def test_toggled_off_it_stands_still_and_toggled_on_it_goes_on(
    bench: Bench, robot: Robot, filtered: list[Any]
) -> None:
    provide("robot_localization")
    kind = import_module("robot_localization.srv").ToggleFilterProcessing

    def toggle(*, on: bool) -> bool:
        answer = bench.call(kind, "/robot7/toggle", kind.Request(on=on), robot.step)
        return bool(answer.status)

    assert toggle(on=False)
    assert not toggle(on=False), "it is off already"
    del filtered[:]
    # What it said before is still on its way.
    bench.until(
        lambda: len(filtered) > 5 and len({each.pose.pose.position.x for each in filtered[-5:]}) == 1,
        robot.step,
    )
    assert toggle(on=True)
    here = filtered[-1].pose.pose.position.x
    bench.until(lambda: abs(filtered[-1].pose.pose.position.x - here) > 0.05, robot.step)


@pytest.mark.usefixtures("ekf")
def test_parameters_show_their_defaults_and_do_not_change(bench: Bench, robot: Robot) -> None:
    names = ["frequency", "odom0", "sensor_timeout", "odom_frame"]
    request = GetParameters.Request(names=names)
    frequency, topic, timeout, frame = bench.call(
        GetParameters, "/robot7/ekf/get_parameters", request, robot.step
    ).values
    assert (frequency.double_value, topic.string_value) == (50.0, "wheel/odometry")
    assert (timeout.double_value, frame.string_value) == (0.02, "robot7/odom")
    value = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=5.0)
    change = SetParameters.Request(parameters=[Parameter(name="frequency", value=value)])
    (result,) = bench.call(SetParameters, "/robot7/ekf/set_parameters", change, robot.step).results
    assert not result.successful
    assert "at the start only" in result.reason


def test_a_filter_in_the_map_corrects_an_odometry_that_moves(
    start: Callable[..., Ekf], bench: Bench, pose: Make
) -> None:
    """A beacon, itself moved about on /tf, sees the robot; odometry has drifted by two metres.

    Started disabled, it first waits for its service; on the system's clock, with a whole number as frequency.
    """
    config = "[true, true, false, false, false, true, " + ", ".join(["false"] * 9) + "]"
    start(
        *("-r", "__ns:=/mapper", "-r", "__node:=global_filter"),
        *_parameters(frequency=20, world_frame="map", odom_frame="m/odom", base_link_frame="m/base"),
        *_parameters(pose0="beacon", pose0_config=config, two_d_mode="true", disabled_at_startup="true"),
        *_parameters(publish_acceleration="true", print_diagnostics="true"),
    )
    beacon = bench.node.create_publisher(type(pose(0, (0.0,) * 6)), "/mapper/beacon", 10)
    transforms = bench.node.create_publisher(tf_message_type(), "/tf", 100)
    filtered = bench.collect(Odometry, "/mapper/odometry/filtered")
    accelerations = bench.collect(AccelWithCovarianceStamped, "/mapper/accel/filtered")
    diagnostics = bench.collect(DiagnosticArray, "/diagnostics")
    broadcast = bench.collect(tf_message_type(), "/tf")

    def step() -> None:
        now = time.time_ns()
        transforms.publish(_transforms("map", "m/beacon", now, 10.0))
        transforms.publish(_transforms("m/odom", "m/base", now, 5.0))
        beacon.publish(pose(now, (-3.0, 0.0, 0.0, 0.0, 0.0, 0.0), frame="m/beacon"))

    bench.until(lambda: bench.sees("/mapper/global_filter"), step)
    bench.until(lambda: len(diagnostics) > 0, step)
    assert not filtered
    bench.call(Empty, "/mapper/enable", Empty.Request(), step, server="/mapper/global_filter")
    bench.until(lambda: filtered and accelerations, step)
    assert filtered[-1].header.frame_id == "map"
    assert filtered[-1].pose.pose.position.x == pytest.approx(7.0, abs=0.01)
    assert accelerations[-1].header.frame_id == "m/base"

    def corrections() -> list[Any]:
        every = (stamped for message in broadcast for stamped in message.transforms)
        return [stamped for stamped in every if stamped.child_frame_id == "m/odom"]

    bench.until(corrections, step)
    assert corrections()[-1].header.frame_id == "map"
    assert corrections()[-1].transform.translation.x == pytest.approx(2.0, abs=0.01)
    status = diagnostics[-1].status[0]
    assert status.name == "global_filter: Filter diagnostic updater"
    assert all(value.key != "X_configuration" for value in status.values)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_quietly_and_takes_it_off_the_graph(
    start: Callable[..., Ekf], bench: Bench, number: signal.Signals
) -> None:
    """One that just vanishes is believed for twenty seconds, and so may be one whose farewell gets lost."""

    def leaves(namespace: str) -> bool:
        ekf = start("-r", f"__ns:={namespace}")
        bench.until(lambda: bench.sees(f"{namespace}/ekf"))
        assert ekf.end(number) == 0
        assert "Traceback" not in ekf.said
        left = time.monotonic()
        bench.until(lambda: not bench.sees(f"{namespace}/ekf") or time.monotonic() > left + 10.0)
        return not bench.sees(f"{namespace}/ekf")

    assert any(leaves(f"/ending{number.value}{trial}") for trial in "abc")


def test_a_signal_while_it_starts_ends_it_just_as_quietly(start: Callable[..., Ekf]) -> None:
    """The process blocks the signals as its first act; from then on they wait until the node can leave."""
    ekf = start()
    status = Path(f"/proc/{ekf.process.pid}/status")
    terminate = 1 << (signal.SIGTERM - 1)
    end = time.monotonic() + DEADLINE
    while not terminate & int(status.read_text().partition("SigBlk:")[2].split()[0], 16):
        assert time.monotonic() < end
    assert ekf.end(signal.SIGTERM) == 0
    assert "Traceback" not in ekf.said


def test_a_covariance_of_a_wrong_size_ends_it_with_one_line(start: Callable[..., Ekf]) -> None:
    ekf = start(*_parameters(process_noise_covariance="[0.1, 0.2]"))
    assert ekf.process.wait(DEADLINE) == 1
    assert "process_noise_covariance has 2 entries" in ekf.said
    assert "Traceback" not in ekf.said


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("process_noise_covariance: [0.5, 0]", "Sequence should be of same type"),
        ("odom0_config: []", "an empty list"),
    ],
)
def test_a_parameter_file_that_ros_cannot_read_is_told_in_a_line(
    start: Callable[..., Ekf], tmp_path: Path, line: str, said: str
) -> None:
    file = tmp_path / "ekf.yaml"
    file.write_text(f"/**:\n  ros__parameters:\n    {line}\n")
    ekf = start("--params-file", str(file))
    assert ekf.process.wait(DEADLINE) == 1
    assert said in ekf.said
    assert "Traceback" not in ekf.said


def test_what_is_wrong_but_not_fatal_is_logged(start: Callable[..., Ekf], bench: Bench) -> None:
    file = "/nowhere/trace.txt"
    wrong = _parameters(frequenci=3.0, initial_state="[1.0]", debug="true", debug_out_file=file)
    ekf = start("-r", "__ns:=/faulty", *wrong)
    bench.until(lambda: bench.sees("/faulty/ekf"))
    told = ("initial_state has 1 entries", "did you mean frequency?", "the debug file cannot be written")
    bench.until(lambda: all(part in ekf.said for part in told))


def test_killed_and_started_again_it_is_right_about_its_velocities(
    start: Callable[..., Ekf], bench: Bench, pose: Make
) -> None:
    """It stands at the origin, unsure of its place by as much as the wheels say; where `set_pose` puts it, it is sure.

    The one that is killed was sure of its place, which tells what it has said from what comes after.
    """
    robot = Robot(bench, "restarted")
    frames = _parameters(odom_frame="restarted/odom", base_link_frame="restarted/base", use_sim_time="true")
    arguments = ("-r", "__ns:=/restarted", "--params-file", str(PARAMETERS), *frames)
    filtered = bench.collect(Odometry, "/restarted/odometry/filtered")
    first = start(*arguments)
    bench.until(lambda: filtered, robot.step)
    assert first.end(signal.SIGKILL) == -signal.SIGKILL
    assert np.sqrt(filtered[-1].pose.covariance[0]) < 1.0
    robot.place = (6.0, 8.0)
    start(*arguments)

    def hearing() -> list[Any]:
        """What the second says from the first time that it has heard both inputs, which discovery does not bring at once."""
        unsure = [message for message in filtered if np.sqrt(message.pose.covariance[0]) > 5.0]
        return [each for each in unsure if each.twist.twist.linear.x and each.twist.twist.angular.z]

    bench.until(hearing, robot.step)
    judged = _stamp(hearing()[0]) + NANOSECONDS
    bench.until(lambda: _stamp(filtered[-1]) > judged, robot.step)
    late = next(message for message in hearing() if _stamp(message) > judged)
    assert late.twist.twist.linear.x == pytest.approx(1.0, abs=0.02)
    assert late.twist.twist.angular.z == pytest.approx(0.2, abs=0.02)
    assert np.sqrt(late.pose.covariance[0]) == pytest.approx(10.0, rel=0.2)
    topic = bench.node.create_publisher(type(pose(0, (0.0,) * 6)), "/restarted/set_pose", 10)
    bench.until(topic.get_subscription_count, robot.step)
    topic.publish(pose(robot.now, (300.0, 8.0, 0.0, 0.0, 0.0, 0.0), 0.01, frame="restarted/odom"))
    bench.until(lambda: filtered[-1].pose.pose.position.x > 250.0, robot.step)
    sure = next(message for message in filtered if message.pose.pose.position.x > 250.0)
    assert np.sqrt(sure.pose.covariance[0]) < 1.0


def test_a_visit_hands_over_all_that_came_between(bench: Bench) -> None:
    visited = VisitedSubscriptions(bench.node)
    received: list[Any] = []
    subscription = visited.add(Clock, "ticking", received.append, QoSProfile(depth=1))
    publisher = bench.node.create_publisher(Clock, "ticking", 100)
    bench.until(publisher.get_subscription_count)
    for _ in range(30):
        publisher.publish(Clock())
    assert received == []
    bench.until(lambda: len(received) == 30, visited.visit)
    visited.remove(subscription)
    bench.until(lambda: not publisher.get_subscription_count())


@pytest.mark.parametrize(
    ("due", "now", "following"),
    [(100, 100, 120), (100, 101, 120), (100, 119, 120), (100, 120, 140), (100, 555, 560), (100, 30, 50)],
)
def test_ticks_keep_their_rhythm(due: int, now: int, following: int) -> None:
    """A late tick does not shift those after it, and a clock that has gone back starts anew."""
    assert next_tick(due, now, 20) == following
