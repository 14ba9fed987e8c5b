"""Measurements from poses and from IMU orientations, plain, relative to the first or as differences."""

import numpy as np

from bringup.filter.measurement import Measurement
from bringup.filter.mounting import Mountings
from bringup.filter.readings import OrientationReading, PoseReading
from bringup.filter.rigid import IDENTITY, Transform, transform
from bringup.filter.rotation import (
    Vector,
    cross_matrix,
    matrix_from_rpy,
    rpy_from_matrix,
    rpy_from_quaternion,
)
from bringup.filter.settings import NANOSECONDS, Part
from bringup.filter.state import ANGULAR, ORIENTATION, POSE, TWIST, Array, wrap
from bringup.filter.variances import square

_NO_TRANSLATION = np.zeros(3)


class PoseTrack:
    """The earlier poses of one part: its first for `relative`, its previous for `differential`."""

    def __init__(self, part: Part) -> None:
        self._part = part
        self.forget()

    def forget(self) -> None:
        """Start afresh: the next pose is the first one."""
        self._first: Transform | None = None
        self._previous: tuple[int, Transform, Array] | None = None

    def relative(self, pose: Transform) -> Transform:
        """Give a pose as seen from the first one, if the part is relative."""
        if not self._part.relative:
            return pose
        if self._first is None:
            self._first = pose
        return self._first.inverse() @ pose

    def velocity(
        self, stamp: int, pose: Transform, covariance: Array
    ) -> tuple[tuple[float, ...], Array] | None:
        """Give the mean velocity since the previous pose, and its covariance, as upstream weighs it.

        None for the first pose, and for one that follows within no time.
        """
        previous = self._previous
        self._previous = stamp, pose, covariance
        if previous is None or stamp <= previous[0]:
            return None
        dt = (stamp - previous[0]) / NANOSECONDS
        moved = _values(previous[1].inverse() @ pose)
        return tuple([value / dt for value in moved]), (covariance + previous[2]) * dt


class PoseMeasuring:
    """Turns the poses of one part into measurements."""

    def __init__(self, part: Part, *, two_d_mode: bool) -> None:
        self._part = part
        offset = TWIST.start if part.differential else POSE.start
        self.mountings = Mountings(part, part.flags, offset, two_d_mode=two_d_mode)
        self.track = PoseTrack(part)

    def measure(self, reading: PoseReading, frame: Transform, to_base: Transform) -> Measurement | None:
        """Measure from a reading, unless it is the first of a differential part.

        `frame` takes the reading's frame to the world frame; `to_base` is where the base stands in the frame
        whose pose is read. A difference is in the base's axes already and takes no `frame`.
        """
        as_read = to_base is IDENTITY and not self._part.differential and not self._part.relative
        if as_read and frame is IDENTITY:
            values = reading.position + rpy_from_quaternion(reading.orientation)
            return self.mountings.of(frame).measurement(reading.stamp, values, reading.covariance)
        pose = transform(reading.position, reading.orientation)
        if as_read:
            return self.mountings.of(frame).measurement(
                reading.stamp, _values(frame @ pose), reading.covariance
            )
        return self._tracked(reading, pose, frame, to_base)

    def _tracked(
        self, reading: PoseReading, pose: Transform, frame: Transform, to_base: Transform
    ) -> Measurement | None:
        covariance = reading.covariance
        if to_base is not IDENTITY:
            carried = _over_lever_arm(square(covariance), pose.rotation @ to_base.translation)
            covariance = tuple(carried.ravel().tolist())
            pose = pose @ to_base
        if not self._part.differential:
            values = _values(frame @ self.track.relative(pose))
            return self.mountings.of(frame).measurement(reading.stamp, values, covariance)
        moved = self.track.velocity(reading.stamp, pose, square(covariance))
        if moved is None:
            return None
        return self.mountings.of(IDENTITY).turned_measurement(reading.stamp, *moved)


class OrientationMeasuring:
    """Turns the orientations of one IMU into measurements of the base's orientation or, as differences, its turning.

    The mounting's angles are taken off one by one, and what is left is turned by the mounting's yaw (upstream's
    way; exact for a mounting that is turned about the vertical alone).
    """

    def __init__(self, part: Part, *, two_d_mode: bool) -> None:
        self._part = part
        offset = ANGULAR.start if part.differential else ORIENTATION.start
        self.mountings = Mountings(part, part.flags[3:], offset, two_d_mode=two_d_mode)
        self.track = PoseTrack(part)
        self._sensor = IDENTITY
        self._offsets = (0.0, 0.0, 0.0)
        self._heading = IDENTITY.rotation

    def measure(self, reading: OrientationReading, sensor: Transform) -> Measurement | None:
        """Measure from a reading; `sensor` is where the IMU stands in the base frame."""
        if sensor is not self._sensor:
            self._sensor = sensor
            self._offsets = rpy_from_matrix(sensor.rotation)
            self._heading = matrix_from_rpy(0.0, 0.0, self._offsets[2])
        mounting = self.mountings.of(sensor, self._heading)
        angles = rpy_from_quaternion(reading.orientation)
        level = mounting.turned(_less(angles, self._offsets))
        if not (self._part.relative or self._part.differential):
            return mounting.measurement(reading.stamp, level, reading.covariance)
        pose = Transform(matrix_from_rpy(*level), _NO_TRANSLATION)
        if not self._part.differential:
            level = rpy_from_matrix(self.track.relative(pose).rotation)
            return mounting.measurement(reading.stamp, level, reading.covariance)
        covariance = self._heading @ square(reading.covariance) @ self._heading.T
        moved = self.track.velocity(reading.stamp, pose, covariance)
        if moved is None:
            return None
        return mounting.turned_measurement(reading.stamp, moved[0][3:], moved[1])


def _values(pose: Transform) -> tuple[float, ...]:
    return *pose.translation.tolist(), *rpy_from_matrix(pose.rotation)


def _less(angles: Vector, offsets: Vector) -> Vector:
    roll, pitch, yaw = angles
    a, b, c = offsets
    return wrap(roll - a), wrap(pitch - b), wrap(yaw - c)


def _over_lever_arm(covariance: Array, arm: Array) -> Array:
    """Covariance of a point at `arm` from the measured one, all in the axes of the reading's frame.

    The rotations are about fixed axes and stay; they move the point across the arm.
    """
    carry = np.eye(6)
    carry[:3, 3:] = -cross_matrix(arm)
    return carry @ covariance @ carry.T
