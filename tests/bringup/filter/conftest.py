"""Messages as sensors send them, and filters set up from parameters as a user writes them."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest
from geometry_msgs.msg import PoseWithCovarianceStamped, TwistWithCovarianceStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu

from bringup.filter.localization import Localization
from bringup.filter.parameters import read_settings
from bringup.filter.rotation import quaternion_from_rpy
from bringup.filter.settings import NANOSECONDS, Settings

SECOND = NANOSECONDS


class Complaints:
    """Collects what a parameter reader says."""

    def __init__(self) -> None:
        self.warnings: list[str] = []
        self.errors: list[str] = []

    def warning(self, message: str) -> None:
        self.warnings.append(message)

    def error(self, message: str) -> None:
        self.errors.append(message)


@pytest.fixture
def complaints() -> Complaints:
    return Complaints()


@pytest.fixture
def settings_of(complaints: Complaints) -> Callable[..., Settings]:
    """Settings from parameters that must not give cause for complaint."""

    def read(**parameters: object) -> Settings:
        settings, _ = read_settings(parameters, complaints)
        assert (complaints.warnings, complaints.errors) == ([], [])
        return settings

    return read


@pytest.fixture
def filter_of(settings_of: Callable[..., Settings]) -> Callable[..., Localization]:
    return lambda **parameters: Localization(settings_of(**parameters))


@pytest.fixture
def config() -> Callable[..., list[bool]]:
    """A `_config` with the named variables on."""
    names = (
        "x",
        "y",
        "z",
        "roll",
        "pitch",
        "yaw",
        "vx",
        "vy",
        "vz",
        "vroll",
        "vpitch",
        "vyaw",
        "ax",
        "ay",
        "az",
    )

    def flags(*wanted: str) -> list[bool]:
        assert set(wanted) <= set(names)
        return [name in wanted for name in names]

    return flags


def _stamped(message: Any, stamp: int, frame: str) -> Any:
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, SECOND)
    message.header.frame_id = frame
    return message


def _fill_pose(message: Any, pose: Sequence[float], variance: float) -> None:
    position, orientation = message.pose.pose.position, message.pose.pose.orientation
    position.x, position.y, position.z = map(float, pose[:3])
    orientation.x, orientation.y, orientation.z, orientation.w = quaternion_from_rpy(*pose[3:])
    message.pose.covariance = (np.eye(6) * variance).reshape(-1)


def _fill_twist(message: Any, twist: Sequence[float], variance: float) -> None:
    linear, angular = message.twist.twist.linear, message.twist.twist.angular
    linear.x, linear.y, linear.z = map(float, twist[:3])
    angular.x, angular.y, angular.z = map(float, twist[3:])
    message.twist.covariance = (np.eye(6) * variance).reshape(-1)


@pytest.fixture
def odometry() -> Callable[..., Any]:
    def make(  # a message of nav_msgs
        stamp: int,
        *,
        pose: Sequence[float] = (0.0,) * 6,
        twist: Sequence[float] = (0.0,) * 6,
        variance: float = 1e-6,
        frame: str = "odom",
        child: str = "base_link",
    ) -> Any:
        message = _stamped(Odometry(), stamp, frame)
        message.child_frame_id = child
        _fill_pose(message, pose, variance)
        _fill_twist(message, twist, variance)
        return message

    return make


@pytest.fixture
def pose() -> Callable[..., Any]:
    def make(stamp: int, values: Sequence[float], variance: float = 1e-6, frame: str = "odom") -> Any:
        message = _stamped(PoseWithCovarianceStamped(), stamp, frame)
        _fill_pose(message, values, variance)
        return message

    return make


@pytest.fixture
def twist() -> Callable[..., Any]:
    def make(stamp: int, values: Sequence[float], variance: float = 1e-6, frame: str = "base_link") -> Any:
        message = _stamped(TwistWithCovarianceStamped(), stamp, frame)
        _fill_twist(message, values, variance)
        return message

    return make


@pytest.fixture
def imu() -> Callable[..., Any]:
    def make(
        stamp: int,
        *,
        rpy: Sequence[float] | None = None,
        omega: Sequence[float] | None = None,
        force: Sequence[float] | None = None,
        variance: float = 1e-6,
        frame: str = "base_link",
    ) -> Any:
        """What is None is marked as not measured."""
        message = _stamped(Imu(), stamp, frame)
        parts = (
            (rpy, message.orientation_covariance),
            (omega, message.angular_velocity_covariance),
            (force, message.linear_acceleration_covariance),
        )
        for values, covariance in parts:
            covariance[[0, 4, 8]] = variance if values is not None else -1.0
        turn = message.orientation
        turn.x, turn.y, turn.z, turn.w = quaternion_from_rpy(*(rpy or (0.0, 0.0, 0.0)))
        for values, vector in ((omega, message.angular_velocity), (force, message.linear_acceleration)):
            vector.x, vector.y, vector.z = map(float, values or (0.0, 0.0, 0.0))
        return message

    return make


@pytest.fixture
def feed() -> Callable[..., int]:
    """Hand a filter one message per period, with its own updates in between on the clock of the messages."""

    def run(
        localization: Localization,
        sensor: str,
        make: Callable[[int], Any],
        *,
        rate: float,
        count: int,
        start: int = SECOND,
        frequency: float = 30.0,
    ) -> int:
        period, cycle = round(SECOND / rate), round(SECOND / frequency)
        tick = start
        for number in range(count):
            stamp = start + number * period
            while tick <= stamp:
                localization.update(tick)
                tick += cycle
            localization.receive(sensor, make(stamp), stamp)
        end = start + count * period
        localization.update(max(tick, end))
        return end

    return run
