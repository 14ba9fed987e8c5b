"""Measurements from velocities and from accelerations, taken from the sensor's place to the base's."""

import numpy as np

from bringup.filter.measurement import Measurement
from bringup.filter.mounting import Mountings
from bringup.filter.readings import AccelerationReading, TwistReading
from bringup.filter.rigid import IDENTITY, Transform
from bringup.filter.rotation import cross, matrix_from_quaternion, matrix_from_rpy
from bringup.filter.settings import Part
from bringup.filter.state import ACCELERATION, ANGULAR, ORIENTATION, TWIST, Array


class TwistMeasuring:
    """Turns the velocities of one part into measurements."""

    def __init__(self, part: Part, *, two_d_mode: bool) -> None:
        self._mountings = Mountings(part, TWIST.start, two_d_mode=two_d_mode)

    def measure(self, reading: TwistReading, sensor: Transform, state: Array) -> Measurement:
        """Measure from a reading; `sensor` is where its frame stands in the base frame.

        What the sensor sees because the base turns under it is taken off with the present estimate's omega.
        """
        mounting = self._mountings.of(sensor)
        vector = mounting.turned(np.array(reading.linear + reading.angular))
        if mounting.moves:
            vector[:3] += cross(sensor.translation, state[ANGULAR])
        return mounting.measurement(reading.stamp, vector, mounting.turned_covariance(reading.covariance))


class AccelerationMeasuring:
    """Turns the specific forces of one IMU into measurements of the base's acceleration.

    `gravity` (m/s^2) is None where the IMU has removed it itself.
    """

    def __init__(self, part: Part, gravity: float | None, *, two_d_mode: bool) -> None:
        self._relative = part.relative
        self._weight = None if gravity is None else np.array((0.0, 0.0, gravity))
        self._mountings = Mountings(part, ACCELERATION.start, two_d_mode=two_d_mode)

    def measure(
        self, reading: AccelerationReading, sensor: Transform, state: Array, angular_acceleration: Array
    ) -> Measurement:
        """Measure from a reading; `sensor` is where the IMU stands in the base frame."""
        mounting = self._mountings.of(sensor)
        force = np.array(reading.acceleration)
        if self._weight is not None:
            force -= self._weight_at_sensor(self._weight, reading, sensor, state)
        vector = mounting.turned(force)
        if sensor is not IDENTITY:
            arm, omega = sensor.translation, state[ANGULAR]
            vector = vector + cross(arm, angular_acceleration) - cross(cross(arm, omega), omega)
        return mounting.measurement(reading.stamp, vector, mounting.turned_covariance(reading.covariance))

    def _weight_at_sensor(
        self, weight: Array, reading: AccelerationReading, sensor: Transform, state: Array
    ) -> Array:
        """Specific force of the sensor at rest, in the sensor's axes.

        It is taken off before the mounting's rotation (upstream mixes the two up in 2024; its fix of 2025 agrees
        with this). The attitude is the IMU's own or, where it measures none, the estimate's. A relative
        orientation counts from the sensor's attitude on a level base.
        """
        if reading.orientation is None:
            base = matrix_from_rpy(*state[ORIENTATION].tolist())
            return sensor.rotation.T @ (base.T @ weight)
        attitude = matrix_from_quaternion(reading.orientation)
        if self._relative:
            attitude = sensor.rotation @ attitude
        return attitude.T @ weight
