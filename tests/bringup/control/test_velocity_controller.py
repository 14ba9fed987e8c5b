"""The node for real: a process of its own, simulated time, and another participant that plays the robot."""

import signal
import time
from collections.abc import Iterator
from typing import Any

import pytest
from geometry_msgs.msg import Twist
from rcl_interfaces.msg import ParameterType
from rcl_interfaces.srv import DescribeParameters
from std_srvs.srv import Trigger

from bringup.control.settings import table
from tests.bringup.control.bench import DEADLINE, NODE, TICK, Bench, controller, on_bench

# What rclpy imports to find its types still uses the old name of a standard module.
pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")


@pytest.fixture(autouse=True, scope="module")
def _localhost() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        yield


@pytest.fixture(scope="module")
def shared() -> Iterator[Bench]:
    with on_bench(40, "mode:=hold") as (bench, _):
        yield bench


@pytest.fixture
def bench(shared: Bench) -> Bench:
    """The one node of these tests, standing still with its own defaults and all sensors on."""
    shared.scanning = shared.locating = True
    shared.ahead = float("inf")
    assert shared.set(mode="hold", max_linear_vel=0.5, obstacle_distance=0.5, robot_radius=0.25)[0][0]
    shared.until(shared.drives(0.0), "standing still")
    return shared


def test_every_parameter_is_described_with_its_type_and_range(bench: Bench) -> None:
    request = DescribeParameters.Request(names=[each.name for each in table()])
    answer = bench.call(DescribeParameters, f"{NODE}/describe_parameters", request)
    for each, described in zip(table(), answer.descriptors, strict=True):
        assert described.description == each.description
        assert described.additional_constraints == each.constraints
        bounds = list(described.floating_point_range) + list(described.integer_range)
        if isinstance(each.default, str):
            assert described.type == ParameterType.PARAMETER_STRING
        elif isinstance(each.default, bool):
            assert described.type == ParameterType.PARAMETER_BOOL
        else:
            assert [(bound.from_value, bound.to_value) for bound in bounds] == [(each.minimum, each.maximum)]


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"max_linear_vel": 0.9}, ["max_linear_vel", "0.9", "0.8"]),
        ({"max_angular_vel": float("nan")}, ["max_angular_vel", "nan", "1.5"]),
        ({"max_linear_vel": "fast"}, ["type", "DOUBLE", "STRING"]),
        ({"mode": "fly"}, ["mode", "fly", "linear, rotational, wander, hold"]),
        ({"obstacle_distance": 0.2}, ["obstacle_distance (0.2 m) must exceed robot_radius (0.25 m)"]),
        ({"robot_radius": 0.7}, ["obstacle_distance (0.5 m) must exceed robot_radius (0.7 m)"]),
    ],
)
def test_a_refused_parameter_says_why_and_stays_as_it_was(
    bench: Bench, values: dict[str, Any], words: list[str]
) -> None:
    before = bench.get(*values)
    [(successful, reason)] = bench.set(**values)
    assert not successful
    for word in words:
        assert word in reason
    assert bench.get(*values) == before


def test_a_set_of_parameters_is_taken_as_a_whole_or_not_at_all(bench: Bench) -> None:
    [(successful, reason)] = bench.set(atomically=True, max_linear_vel=0.3, robot_radius=0.7)
    assert not successful
    assert "must exceed" in reason
    assert bench.get("max_linear_vel", "robot_radius") == [0.5, 0.25]
    assert bench.set(atomically=True, robot_radius=0.7, obstacle_distance=0.9) == [(True, "")]
    assert bench.get("robot_radius", "obstacle_distance") == [0.7, 0.9]
    assert bench.set(atomically=True, robot_radius=0.25, obstacle_distance=0.5) == [(True, "")]


def test_services_and_the_parameter_change_the_mode_which_is_told_to_all(bench: Bench) -> None:
    for name, mode in (
        ("velocity_controller/rotational", "rotational"),
        ("velocity_controller/linear", "linear"),
        ("switch_mode", "rotational"),
        ("switch_mode", "wander"),
        ("switch_mode", "hold"),
        ("velocity_controller/wander", "wander"),
        ("velocity_controller/hold", "hold"),
    ):
        answer = bench.call(Trigger, f"/robot1/{name}", Trigger.Request())
        assert (answer.success, answer.message) == (True, mode)
        assert bench.get("mode") == [mode]
        bench.until(lambda mode=mode: bench.modes[-1] == mode, f"the topic says {mode}")  # type: ignore[misc]
    bench.set(mode="linear")
    bench.until(lambda: bench.modes[-1] == "linear", "the topic follows the parameter")


def test_it_turns_in_rotational_mode(bench: Bench) -> None:
    bench.set(mode="rotational")
    bench.until(lambda: bench.commands[-1].angular.z > 0.99, "turning")
    assert bench.commands[-1].linear.x == 0.0


def test_it_wanders(bench: Bench) -> None:
    bench.set(mode="wander")
    bench.until(lambda: bench.commands[-1].linear.x > 0.1, "driving about")


def test_it_drives_as_fast_as_allowed_and_stops_before_an_obstacle(bench: Bench) -> None:
    bench.set(mode="linear")
    bench.until(bench.drives(0.5), "driving")
    bench.set(max_linear_vel=0.2)
    bench.until(bench.drives(0.2), "driving at the new speed")
    bench.ahead = 0.45
    bench.until(bench.drives(0.0), "standing before the obstacle")
    bench.ahead = 3.0
    bench.until(bench.drives(0.2), "driving on")


@pytest.mark.parametrize(("sensor", "timeout"), [("scanning", 0.5), ("locating", 0.2)])
def test_it_stops_when_a_sensor_falls_silent_and_drives_on_when_it_is_back(
    bench: Bench, sensor: str, timeout: float
) -> None:
    bench.set(mode="linear")
    bench.until(bench.drives(0.5), "driving")
    setattr(bench, sensor, False)
    lost = bench.time
    bench.until(lambda: bench.commands[-1].linear.x < 0.49, "braking")
    assert bench.time - lost > timeout - 0.1
    bench.until(bench.drives(0.0), "standing")
    setattr(bench, sensor, True)
    bench.until(bench.drives(0.5), "driving again")


def test_its_health_is_told(bench: Bench) -> None:
    bench.set(mode="linear")
    bench.until(bench.is_told(b"\x00", "driving: mode linear"), "all is well")
    bench.ahead = 0.45
    bench.until(bench.is_told(b"\x01", "blocked by an obstacle"), "something is in the way")
    bench.locating = False
    bench.until(bench.is_told(b"\x02", "standing still: no odometry for 0.2 s"), "odometry is missed")
    values = {each.key: each.value for each in bench.health["robot1/velocity_controller: driving"].values}
    assert values["mode"] == "linear"
    assert float(values["age of the odometry"]) >= 0.2  # as it is rounded


@pytest.mark.parametrize("seconds", [-8.0, 100.0])
def test_it_drives_on_when_the_clock_has_jumped(bench: Bench, seconds: float) -> None:
    bench.tick += 500
    bench.set(mode="linear")
    bench.until(bench.drives(0.5), "driving")
    bench.tick += round(seconds / TICK)
    del bench.commands[:]
    bench.until(lambda: len(bench.commands) > 10 and bench.drives(0.5)(), "driving on")


def test_commands_come_at_10_hz_of_simulated_time(bench: Bench) -> None:
    """Time waits for each command, so that a busy machine changes nothing."""
    before = len(bench.commands)
    for number in range(1, 31):
        end = bench.tick + 5
        bench.until(lambda end=end: bench.tick >= end, "a tenth of a second")  # type: ignore[misc]
        bench.until(
            lambda least=before + number: len(bench.commands) >= least,  # type: ignore[misc]
            "a command for every tenth",
            ticks=0,
        )
    assert len(bench.commands) - before <= 33


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_cleanly_with_a_last_order_to_stand(number: signal.Signals) -> None:
    with on_bench(41, "mode:=linear") as (bench, process):
        bench.until(bench.drives(0.5), "driving")
        process.send_signal(number)
        _, errors = process.communicate(timeout=DEADLINE)
        assert process.returncode == 0
        assert "Traceback" not in errors
        end = time.monotonic() + DEADLINE
        while bench.commands[-1] != Twist():
            assert time.monotonic() < end, "the last command is not zero"
            bench.executor.spin_once(timeout_sec=0.1)


@pytest.mark.parametrize(
    ("parameter", "words"),
    [
        ("max_linear_vel:=7.0", ["max_linear_vel", "7.0", "0.8"]),
        ("max_linear_vel:=fast", ["max_linear_vel", "fast", "DOUBLE"]),
        ("obstacle_distance:=0.2", ["obstacle_distance (0.2 m) must exceed robot_radius (0.25 m)"]),
        ("mode:=fly", ["mode is 'fly'"]),
    ],
)
def test_unusable_parameters_end_the_start_with_a_reason(parameter: str, words: list[str]) -> None:
    with controller(42, parameter) as process:
        _, errors = process.communicate(timeout=DEADLINE)
    assert process.returncode == 1
    assert "Traceback" not in errors
    for word in words:
        assert word in errors
