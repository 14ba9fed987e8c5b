"""A Husky driven outdoors for six and a half minutes, as robot_localization's own test plays it."""

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.rosbag1 import Reader
from rosbags.typesys import Stores, get_typestore

from bringup.filter.localization import Localization
from bringup.filter.rotation import quaternion_from_rpy
from bringup.filter.settings import NANOSECONDS
from bringup.filter.state import ORIENTATION, PITCH, POSE, ROLL, YAW
from bringup.filter.transforms import Sample

BAG = Path(__file__).parents[2] / "data" / "robot_localization" / "test1.bag"
TOPICS = {"/husky_velocity_controller/odom": "odom0", "/imu/data": "imu0"}
IMU_PLACE = Sample(0, (0.0, -0.3, 0.52), quaternion_from_rpy(math.pi / 2, 0.0, -math.pi / 2))
FREQUENCY = 30
END = (-40.0454, -76.9988, -2.6974)
TOLERANCE = 1.0452


def _recorded() -> Iterator[tuple[int, str, Any]]:
    store = get_typestore(Stores.ROS1_NOETIC)
    with Reader(BAG) as reader:
        for connection, received, raw in reader.messages():
            if connection.topic in TOPICS:
                yield received, TOPICS[connection.topic], store.deserialize_ros1(raw, connection.msgtype)


def _play(localization: Localization) -> np.ndarray:
    """Play the recording and give the states (one row per update), a second of silence at the end included."""
    period = NANOSECONDS // FREQUENCY
    states = []
    tick = None
    for received, sensor, message in _recorded():
        tick = received if tick is None else tick
        while tick <= received:
            localization.update(tick)
            tick += period
            if (estimate := localization.estimate()) is not None:
                states.append(estimate.state)
        localization.receive(sensor, message, received)
    assert tick is not None
    for number in range(FREQUENCY):
        localization.update(tick + number * period)
    last = localization.estimate()
    assert last is not None
    return np.array([*states, last.state])


@pytest.fixture
def states(filter_of: Callable[..., Localization], config: Callable[..., list[bool]]) -> np.ndarray:
    localization = filter_of(
        frequency=FREQUENCY,
        sensor_timeout=0.1,
        odom0="/husky_velocity_controller/odom",
        odom0_config=config("vx", "vy", "vz"),
        imu0="/imu/data",
        imu0_config=config("roll", "pitch", "yaw", "vroll", "vpitch", "ax", "ay", "az"),
        imu0_remove_gravitational_acceleration=True,
    )
    localization.frames.add_static("base_link", "imu_link", IMU_PLACE)
    states = _play(localization)
    assert localization.notices.take() == {}
    return states


def test_the_drive_ends_where_upstream_says_and_upright(states: np.ndarray) -> None:
    """The place alone cannot tell an attitude that is upside down, so the attitude is checked as well."""
    assert np.linalg.norm(states[-1][POSE][:3] - END) < TOLERANCE
    assert np.abs(states[:, ROLL]).max() < 0.1
    assert np.abs(states[:, PITCH]).max() < 0.1
    assert states[-1][YAW] == pytest.approx(2.88, abs=0.02)
    assert (np.abs(states[:, ORIENTATION]) <= math.pi).all()
