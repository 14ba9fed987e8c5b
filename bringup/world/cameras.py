"""Each robot's camera on the ROS graph: images and how they were taken, rendered while somebody listens."""

from __future__ import annotations

import array
import math
from typing import TYPE_CHECKING

from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import CameraInfo, Image

from bringup.world import messages
from bringup.world.body import CAMERA_FOVY
from bringup.world.sensing import due

if TYPE_CHECKING:
    from rclpy.node import Node

    from bringup.world.rendering import Renderer
    from bringup.world.simulation import Simulation


class Cameras:
    """`ROBOT/camera/image_raw` and `camera_info` of all robots."""

    def __init__(
        self, node: Node, simulation: Simulation, renderer: Renderer, size: tuple[int, int], rate: float
    ) -> None:
        self._simulation, self._renderer, self._size, self._rate = simulation, renderer, size, rate
        self._publishers = [
            (
                robot.name,
                node.create_publisher(Image, f"{robot.name}/camera/image_raw", qos_profile_sensor_data),
                node.create_publisher(
                    CameraInfo, f"{robot.name}/camera/camera_info", qos_profile_sensor_data
                ),
            )
            for robot in simulation.model.robots
        ]

    def publish(self) -> None:
        """Take the images that are due and wanted."""
        ticks = self._simulation.ticks
        if not due(ticks, self._rate):
            return
        width, height = self._size
        for robot, images, infos in self._publishers:
            if infos.get_subscription_count():
                info = camera_info(robot, width, height)
                messages.stamp(info.header.stamp, ticks)
                infos.publish(info)
            if not images.get_subscription_count():
                continue
            seen = self._renderer.render(self._simulation.data, f"{robot}/camera", width, height)
            image = Image(width=width, height=height, encoding="rgb8", step=3 * width)
            image.header.frame_id = f"{robot}/camera_optical_frame"
            image.data = array.array("B", seen.tobytes())
            messages.stamp(image.header.stamp, ticks)
            images.publish(image)


def camera_info(robot: str, width: int, height: int) -> CameraInfo:
    """A pinhole camera without distortion, its axis through the middle of the image."""
    focal = height / 2 / math.tan(math.radians(CAMERA_FOVY) / 2)
    info = CameraInfo(width=width, height=height, distortion_model="plumb_bob", d=[0.0] * 5)
    info.header.frame_id = f"{robot}/camera_optical_frame"
    info.k = [focal, 0.0, width / 2, 0.0, focal, height / 2, 0.0, 0.0, 1.0]
    info.r = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    info.p = [focal, 0.0, width / 2, 0.0, 0.0, focal, height / 2, 0.0, 0.0, 0.0, 1.0, 0.0]
    return info
