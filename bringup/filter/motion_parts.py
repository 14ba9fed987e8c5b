"""Measurements from velocities and from accelerations, taken from the sensor's place to the base's."""

import numpy as np

from bringup.filter.measurement import Measurement
from bringup.filter.mounting import Mountings
from bringup.filter.readings import AccelerationReading, TurningReading, TwistReading
from bringup.filter.rigid import Transform
from bringup.filter.rotation import cross, matrix_from_quaternion, matrix_from_rpy, up_seen_by
from bringup.filter.settings import Part
from bringup.filter.state import ACCELERATION, ANGULAR, ORIENTATION, TWIST, Array


class TwistMeasuring:
    """Turns the velocities of one part into measurements."""

    def __init__(self, part: Part, *, two_d_mode: bool) -> None:
        self.mountings = Mountings(part, part.flags, TWIST.start, two_d_mode=two_d_mode)

    def measure(self, reading: TwistReading, sensor: Transform, state: Array) -> Measurement:
        """Measure from a reading; `sensor` is where its frame stands in the base frame.

        What the sensor sees because the base turns under it is taken off with the present estimate's omega.
        """
        mounting = self.mountings.of(sensor)
        vector = mounting.turned(np.array(reading.linear + reading.angular))
        if mounting.arm is not None:
            vector[:3] += cross(mounting.arm, state[ANGULAR])
        return mounting.measurement(reading.stamp, vector, reading.covariance)


class TurningMeasuring:
    """Turns the angular velocities of one IMU into measurements."""

    def __init__(self, part: Part, *, two_d_mode: bool) -> None:
        self.mountings = Mountings(part, part.flags[3:], ANGULAR.start, two_d_mode=two_d_mode)

    def measure(self, reading: TurningReading, sensor: Transform) -> Measurement:
        """Measure from a reading; `sensor` is where the IMU stands in the base frame."""
        mounting = self.mountings.of(sensor)
        vector = mounting.turned(np.array(reading.angular))
        return mounting.measurement(reading.stamp, vector, reading.covariance)


class AccelerationMeasuring:
    """Turns the specific forces of one IMU into measurements of the base's acceleration.

    `gravity` (m/s^2) is None where the IMU has removed it itself.
    """

    def __init__(self, part: Part, gravity: float | None, *, two_d_mode: bool) -> None:
        self._relative = part.relative
        self._gravity = gravity
        self.mountings = Mountings(part, part.flags, ACCELERATION.start, two_d_mode=two_d_mode)

    def measure(
        self, reading: AccelerationReading, sensor: Transform, state: Array, angular_acceleration: Array
    ) -> Measurement:
        """Measure from a reading; `sensor` is where the IMU stands in the base frame."""
        mounting = self.mountings.of(sensor)
        force = np.array(reading.acceleration)
        if self._gravity is not None:
            force -= self._gravity * self._up_at_sensor(reading, sensor, state)
        vector = mounting.turned(force)
        if mounting.arm is not None:
            arm, omega = mounting.arm, state[ANGULAR]
            vector = vector + cross(arm, angular_acceleration) - cross(cross(arm, omega), omega)
        return mounting.measurement(reading.stamp, vector, reading.covariance)

    def _up_at_sensor(self, reading: AccelerationReading, sensor: Transform, state: Array) -> Array:
        """The world's unit vector upwards in the sensor's axes: where the specific force points at rest.

        Gravity is taken off before the mounting's rotation (upstream mixes the two up in 2024; its fix of 2025 agrees
        with this). The attitude is the IMU's own or, where it measures none, the estimate's. A relative
        orientation counts from the sensor's attitude on a level base.
        """
        if reading.orientation is None:
            base = matrix_from_rpy(*state[ORIENTATION].tolist())
            up: Array = sensor.rotation.T @ base[2]
        elif self._relative:
            up = matrix_from_quaternion(reading.orientation).T @ sensor.rotation[2]
        else:
            up = np.array(up_seen_by(reading.orientation))
        return up
