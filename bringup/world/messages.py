"""ROS messages made from the simulation's numbers; every message object is made once and then filled anew."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, LaserScan

from bringup.world import lidar
from bringup.world.body import MOUNTS, Mount
from bringup.world.geometry import Pose, yaw_of
from bringup.world.inertial import InertialNoise, variance
from bringup.world.model import TICKS_PER_SECOND

if TYPE_CHECKING:
    from collections.abc import Sequence

    from builtin_interfaces.msg import Time

NANOSECONDS = 10**9
NANOSECONDS_PER_TICK = NANOSECONDS // TICKS_PER_SECOND
# Rows and columns of (x, y, yaw) and (vx, vyaw) within a message's 6 x 6 covariance.
PLANAR = np.ix_((0, 1, 5), (0, 1, 5))
DRIVEN = np.ix_((0, 5), (0, 5))
# What a wheel cannot know at all, and how well it knows that it does not go sideways (m/s).
UNKNOWN = 1e6
SIDEWAYS = 0.01**2


@lru_cache(maxsize=1)
def seconds(ticks: int) -> tuple[int, int]:
    """The time of a tick in whole seconds and nanoseconds."""
    return divmod(ticks * NANOSECONDS_PER_TICK, NANOSECONDS)


def stamp(time: Time, ticks: int) -> Time:
    """Set a time to that of a tick."""
    time.sec, time.nanosec = seconds(ticks)
    return time


def ticks_of(time: Time) -> float:
    """The tick of a time; between two ticks it is a fraction."""
    return float((time.sec * NANOSECONDS + time.nanosec) / NANOSECONDS_PER_TICK)


def new_odometry(robot: str) -> Odometry:
    """An odometry message of a robot whose numbers are exact."""
    message = Odometry(child_frame_id=f"{robot}/base_footprint")
    message.header.frame_id = f"{robot}/odom"
    return message


def new_wheel_odometry(robot: str) -> Odometry:
    """An odometry message of a robot's wheels: what they cannot measure is marked as unknown."""
    message = new_odometry(robot)
    for axis in (2, 3, 4):
        message.pose.covariance[axis * 7] = UNKNOWN
        message.twist.covariance[axis * 7] = UNKNOWN
    message.twist.covariance[7] = SIDEWAYS
    return message


def pose_of(message: Odometry) -> Pose:
    """The pose in an odometry message."""
    position, turn = message.pose.pose.position, message.pose.pose.orientation
    return Pose(position.x, position.y, yaw_of(turn.w, turn.x, turn.y, turn.z))


def new_imu(robot: str, noise: InertialNoise) -> Imu:
    """A robot's IMU message: six axes, so no orientation (its covariance starts with -1)."""
    message = Imu()
    message.header.frame_id = f"{robot}/imu_link"
    message.orientation_covariance[0] = -1.0
    message.angular_velocity_covariance[::4] = variance(noise.gyro_noise, noise.gyro_bias)
    message.linear_acceleration_covariance[::4] = variance(
        noise.accelerometer_noise, noise.accelerometer_bias
    )
    return message


def new_scan(robot: str) -> LaserScan:
    """A robot's laser scan; all its beams are of one moment."""
    message = LaserScan(
        angle_min=lidar.ANGLE_MIN,
        angle_max=lidar.ANGLE_MIN + lidar.ANGLE_INCREMENT * (lidar.RAYS - 1),
        angle_increment=lidar.ANGLE_INCREMENT,
        scan_time=lidar.PERIOD,
        range_min=lidar.RANGE_MIN,
        range_max=lidar.RANGE_MAX,
        ranges=[0.0] * lidar.RAYS,
    )
    message.header.frame_id = f"{robot}/laser"
    return message


def mounts(robot: str, mounted: Sequence[Mount] = MOUNTS) -> list[TransformStamped]:
    """The transforms of everything that is fixed on a robot, from its `base_footprint` on."""
    transforms = []
    for mount in mounted:
        transform = TransformStamped(child_frame_id=f"{robot}/{mount.child}")
        transform.header.frame_id = f"{robot}/{mount.parent}"
        place = transform.transform.translation
        place.x, place.y, place.z = mount.x, mount.y, mount.z
        turn = transform.transform.rotation
        turn.x, turn.y, turn.z, turn.w = quaternion(mount.roll, mount.pitch, mount.yaw)
        transforms.append(transform)
    return transforms


def quaternion(roll: float, pitch: float, yaw: float) -> tuple[float, float, float, float]:
    """x, y, z and w of a turn about the fixed axes x, y, z, in this order."""
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(a / 2), math.cos(a / 2)) for a in (roll, pitch, yaw))
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def odom_frame(world: str, robot: str, start: Pose) -> TransformStamped:
    """From the frame of the world to where a robot's odometry begins."""
    transform = TransformStamped(child_frame_id=f"{robot}/odom")
    transform.header.frame_id = world
    transform.transform.translation.x, transform.transform.translation.y = start.x, start.y
    turn = transform.transform.rotation
    turn.x, turn.y, turn.z, turn.w = quaternion(0.0, 0.0, start.yaw)
    return transform
