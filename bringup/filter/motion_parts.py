"""Measurements from velocities and from accelerations, taken from the sensor's place to the base's."""

from bringup.filter.measurement import Measurement
from bringup.filter.mounting import Mountings
from bringup.filter.readings import AccelerationReading, TurningReading, TwistReading
from bringup.filter.rigid import Transform
from bringup.filter.rotation import (
    Vector,
    cross,
    matrix_from_quaternion,
    matrix_from_rpy,
    up_seen_by,
    vector,
)
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
        x, y, z = mounting.turned(reading.linear)
        if mounting.arm is not None:
            dx, dy, dz = cross(mounting.arm, vector(state[ANGULAR].tolist()))
            x, y, z = x + dx, y + dy, z + dz
        values = (x, y, z, *mounting.turned(reading.angular))
        return mounting.measurement(reading.stamp, values, reading.covariance)


class TurningMeasuring:
    """Turns the angular velocities of one IMU into measurements."""

    def __init__(self, part: Part, *, two_d_mode: bool) -> None:
        self.mountings = Mountings(part, part.flags[3:], ANGULAR.start, two_d_mode=two_d_mode)

    def measure(self, reading: TurningReading, sensor: Transform) -> Measurement:
        """Measure from a reading; `sensor` is where the IMU stands in the base frame."""
        mounting = self.mountings.of(sensor)
        return mounting.measurement(reading.stamp, mounting.turned(reading.angular), reading.covariance)


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
        x, y, z = reading.acceleration
        if self._gravity is not None:
            g = self._gravity
            up = self._up_at_sensor(reading, sensor, state)
            x, y, z = x - g * up[0], y - g * up[1], z - g * up[2]
        values = mounting.turned((x, y, z))
        if mounting.arm is not None:
            values = _at_base(values, mounting.arm, state, angular_acceleration)
        return mounting.measurement(reading.stamp, values, reading.covariance)

    def _up_at_sensor(self, reading: AccelerationReading, sensor: Transform, state: Array) -> Vector:
        """The world's unit vector upwards in the sensor's axes: where the specific force points at rest.

        Gravity is taken off before the mounting's rotation (upstream mixes the two up in 2024; its fix of 2025 agrees
        with this). The attitude is the IMU's own or, where it measures none, the estimate's. A relative
        orientation counts from the sensor's attitude on a level base.
        """
        if reading.orientation is None:
            base = matrix_from_rpy(*state[ORIENTATION].tolist())
            return vector((sensor.rotation.T @ base[2]).tolist())
        if self._relative:
            return vector((matrix_from_quaternion(reading.orientation).T @ sensor.rotation[2]).tolist())
        return up_seen_by(reading.orientation)


def _at_base(seen: Vector, arm: Vector, state: Array, angular_acceleration: Array) -> Vector:
    """Take off what a sensor at the end of an arm feels because the base turns, and turns ever faster."""
    omega = vector(state[ANGULAR].tolist())
    x, y, z = seen
    dx, dy, dz = cross(arm, vector(angular_acceleration.tolist()))
    cx, cy, cz = cross(cross(arm, omega), omega)
    return x + dx - cx, y + dy - cy, z + dz - cz
