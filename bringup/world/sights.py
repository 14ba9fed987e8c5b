"""What a run shows to eyes: the window, the recording, the cameras' images, and the drawing of the driven paths."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from bringup.world.window import open_window

if TYPE_CHECKING:
    from rclpy.node import Node

    from bringup.world.course import Course


class Sights:
    """All pictures of a run. Raises NoWindowError, NoRenderingError, RecordingError."""

    def __init__(self, node: Node, course: Course) -> None:
        self._node, self._course = node, course
        settings, simulation = course.settings, course.simulation
        self.window: Any = None if settings.headless else open_window(simulation)
        self._renderer = self._recording = self._cameras = None
        if not (settings.record or settings.camera_rate):
            return
        # Here, because most runs render nothing.
        from bringup.world import recording, rendering  # noqa: PLC0415
        from bringup.world.cameras import Cameras  # noqa: PLC0415

        if settings.record:
            self._recording = recording.opened(Path(settings.record))
        width, height = settings.camera_size
        self._renderer = rendering.Renderer(
            simulation.model, max(width, recording.WIDTH), max(height, recording.HEIGHT)
        )
        self._overview = recording.seen(self._renderer, simulation.data)
        if settings.camera_rate:
            self._cameras = Cameras(
                node, simulation, self._renderer, settings.camera_size, settings.camera_rate
            )

    @property
    def closed(self) -> bool:
        """Whether there was a window that somebody has closed."""
        return self.window is not None and not self.window.is_running()

    @property
    def watching(self) -> bool:
        """Whether each tick may have to be seen."""
        return self._recording is not None or self._cameras is not None

    def tick(self) -> None:
        """Take the pictures that are due at this tick."""
        if self._recording is not None:
            self._recording.add(self._course.simulation.ticks, self._overview)
        if self._cameras is not None:
            self._cameras.publish()

    def show(self) -> None:
        """Bring the window up to date, if there is one."""
        if self.window is not None:
            self.window.sync()

    def end(self) -> None:
        """Write what is to be written at the end of a run."""
        settings = self._course.settings
        try:
            if self._recording is not None:
                self._recording.close(self._overview)
                self._node.get_logger().info(f"recording written to {settings.record}")
        except OSError as error:
            self._node.get_logger().error(f"the recording cannot be written: {error}")
        try:
            if settings.picture:
                self._draw(Path(settings.picture))
                self._node.get_logger().info(f"picture written to {settings.picture}")
        except OSError as error:
            self._node.get_logger().error(f"the picture cannot be written: {error}")

    def close(self) -> None:
        """Close the window and give back what renders."""
        if self.window is not None:
            self.window.close()
        if self._renderer is not None:
            self._renderer.close()

    def _draw(self, path: Path) -> None:
        # Here, because a run without a picture needs no Pillow.
        from bringup.world.picture import Driven, write  # noqa: PLC0415

        driven = [
            Driven(
                topics.robot.name,
                topics.robot.start,
                topics.true_trail.points,
                topics.odometry_trail.points,
                topics.filtered_trail.points,
            )
            for topics in self._course.robots
        ]
        write(self._course.simulation.model.layout, driven, path)
