"""The sensors err as their settings say, at the rates they say, the same way for one seed."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bringup.world.drive import Twist
from bringup.world.inertial import Inertial, InertialNoise
from bringup.world.layout import lay_out
from bringup.world.lidar import LidarErrors, reported
from bringup.world.model import load
from bringup.world.odometry import Odometry, WheelErrors
from bringup.world.sensing import Asked, Readings, Sensors, due
from bringup.world.settings import RobotSettings
from bringup.world.simulation import Simulation

EXACT = WheelErrors(left_scale=1.0, right_scale=1.0, slip=0.0, noise=0.0)


def driven(settings: RobotSettings, seed: int, ticks: int = 200) -> list[Readings]:
    simulation = Simulation(load(lay_out("arena", 3, ["robot1"])), settings.limits)
    sensors = Sensors(simulation, 0, settings, seed)
    readings = []
    for _ in range(ticks):
        simulation.tick([Twist(0.4, 0.3)])
        readings.append(sensors.read())
    return readings


def told(readings: list[Readings]) -> bytes:
    parts: list[bytes] = []
    for each in readings:
        if each.odometry:
            parts += [repr(each.odometry.pose).encode(), each.odometry.pose_covariance.tobytes()]
        if each.inertial:
            parts.append(np.array(each.inertial.values).tobytes())
        if each.ranges is not None:
            parts.append(each.ranges.tobytes())
    return b"".join(parts)


def test_one_seed_gives_the_same_readings_and_another_one_others() -> None:
    noisy = RobotSettings(lidar=LidarErrors(dropout=0.1), inertial=InertialNoise(gyro_walk=0.01))
    assert told(driven(noisy, 1)) == told(driven(noisy, 1))
    assert told(driven(noisy, 1)) != told(driven(noisy, 2))


@pytest.mark.parametrize("every", [2, 7])
def test_what_nobody_asks_for_changes_nothing_in_what_is_read_later(every: int) -> None:
    settings = RobotSettings(lidar=LidarErrors(dropout=0.1), inertial=InertialNoise(gyro_walk=0.01))
    whole = driven(settings, 1)
    simulation = Simulation(load(lay_out("arena", 3, ["robot1"])), settings.limits)
    sensors = Sensors(simulation, 0, settings, 1)
    for tick, full in enumerate(whole):
        simulation.tick([Twist(0.4, 0.3)])
        asked = Asked(tick % every == 0, tick % every == 1, tick // 10 % every == 1)
        read = sensors.read_at(simulation.ticks, simulation.moment(), asked)
        wanted = full._replace(
            truth=full.truth if asked.truth else None,
            inertial=full.inertial if asked.inertial else None,
            ranges=full.ranges if asked.ranges else None,
        )
        assert (read.truth, read.inertial) == (wanted.truth, wanted.inertial)
        assert told([read]) == told([wanted])


def test_a_reset_begins_the_same_course_anew() -> None:
    simulation = Simulation(load(lay_out("maze", 3, ["robot1"])))
    sensors = Sensors(simulation, 0, RobotSettings(), 5)
    runs = []
    for _ in range(2):
        readings = []
        for _ in range(100):
            simulation.tick([Twist(0.3, -0.5)])
            readings.append(sensors.read())
        runs.append((told(readings), simulation.data.qpos.tobytes()))
        simulation.reset()
        sensors.reset(RobotSettings())
    assert runs[0] == runs[1]


@given(st.floats(0.1, 100.0), st.integers(0, 10**6))
def test_a_rate_is_kept_over_any_stretch(rate: float, begin: int) -> None:
    times = sum(due(tick, rate) for tick in range(begin + 1, begin + 1001))
    assert abs(times - 10 * rate) <= 1


def test_each_sensor_speaks_at_its_own_rate() -> None:
    settings = RobotSettings(odometry_rate=20.0, imu_rate=25.0, scan_rate=4.0)
    readings = driven(settings, 1)
    assert sum(each.odometry is not None for each in readings) == 40
    assert sum(each.truth is not None for each in readings) == 40
    assert sum(each.inertial is not None for each in readings) == 50
    assert sum(each.ranges is not None for each in readings) == 8
    odometry = [each.odometry for each in readings if each.odometry]
    assert odometry[-1].twist.linear == pytest.approx(0.4, abs=0.02)


def test_an_encoder_counts_in_whole_steps() -> None:
    """A hundred steps per turn: travel and velocity come in multiples of 6.28 mm."""
    errors = replace(EXACT, counts=100)
    odometry = Odometry(errors, 0.02, np.random.default_rng(1))
    step = math.tau * 0.1 / 100
    velocities = [odometry.update((0.07 * n, 0.07 * n)).twist.linear * 0.02 / step for n in range(1, 400)]
    assert np.allclose(velocities, np.round(velocities), atol=1e-6)
    assert set(np.round(velocities)) == {1.0, 2.0}
    last = odometry.update((28.0, 28.0))
    assert last.pose.x == pytest.approx(2.8, abs=step)
    spread = np.array(velocities) * step / 0.02 - 0.07 * 0.1 / 0.02
    assert np.mean(spread**2) < 2 * 2 * last.twist_covariance[0, 0]


def test_a_bias_strays_as_far_as_its_variance_says() -> None:
    noise = InertialNoise(0.0, 0.0, 0.0, 0.0, gyro_walk=0.01, accelerometer_walk=0.1)
    ends, variances = [], (0.0, 0.0)
    for seed in range(60):
        imu = Inertial(noise, np.random.default_rng(seed))
        for _ in range(400):
            values = imu.measure(np.zeros(6), 0.01)
        ends.append(values)
        variances = imu.variances()
    found = np.mean(np.square(ends), axis=0)
    assert variances == pytest.approx((0.01**2 * 4, 0.1**2 * 4), rel=1e-3)
    assert found[:3].mean() == pytest.approx(variances[0], rel=0.35)
    assert found[3:].mean() == pytest.approx(variances[1], rel=0.35)


def test_beams_drop_out_as_often_as_they_should_and_say_so() -> None:
    errors = LidarErrors(noise=0.0, dropout=0.2, range_min=0.5, range_max=6.0)
    ranges = reported(np.linspace(0.1, 8.0, 20_000), errors, np.random.default_rng(4))
    lost = np.isnan(ranges)
    assert lost.mean() == pytest.approx(0.2, abs=0.02)
    finite = ranges[np.isfinite(ranges)]
    assert (finite.min(), finite.max()) == (0.5, pytest.approx(6.0, abs=0.001))
    assert np.isinf(ranges[~lost][-100:]).all()
