"""How far from its origin a robot may be whose filter starts only now."""

import numpy as np

from bringup.filter.readings import Heard, odometry_pose
from bringup.filter.rotation import rpy_from_quaternion
from bringup.filter.state import Array
from bringup.filter.variances import square


def doubt_about_origin(said: Heard) -> Array:
    """Give the covariance (6x6) of a pose that is taken to be zero, by what an odometry says it is.

    A filter that is started again while its robot drives begins at the origin, where the robot is not. An odometry
    that went on counting tells how far away it may be: the second moment of its pose about the origin, the
    same in x and y, since the way there is what it knows least. A robot that has not moved gives its covariance
    alone.
    """
    reading = odometry_pose(said)
    x, y, z = reading.position
    away = x * x + y * y
    turned = [angle * angle for angle in rpy_from_quaternion(reading.orientation)]
    own = np.maximum(np.nan_to_num(square(reading.covariance).diagonal()), 0.0)
    own[:2] = own[:2].max()
    return np.diag(own + np.array((away, away, z * z, *turned)))
