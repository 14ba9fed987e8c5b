"""What the filter can be asked to do: `set_pose`, `toggle`, `enable` and `reset`."""

from collections.abc import Callable
from importlib import import_module
from typing import Any, TypeAlias

from rclpy.node import Node
from std_srvs.srv import Empty

from bringup.filter.localization import Localization, UnusablePoseError
from bringup.filter_node.messages import Message
from orchestra.ros.interfaces.definitions import provide

Request: TypeAlias = Any
Response: TypeAlias = Any

_PACKAGE = "robot_localization"


class Services:
    """The services of one filter; what has arrived is `taken_in` before the estimate is set aside."""

    def __init__(
        self, node: Node, localization: Localization, now: Callable[[], int], take_in: Callable[[], None]
    ) -> None:
        self._logger = node.get_logger()
        self._localization = localization
        self._now = now
        self._take_in = take_in
        provide(_PACKAGE)
        types = import_module(f"{_PACKAGE}.srv")
        node.create_service(types.SetPose, "set_pose", self._set_pose)
        node.create_service(types.ToggleFilterProcessing, "toggle", self._toggle)
        node.create_service(Empty, "enable", self._enable)
        node.create_service(Empty, "reset", self._reset)

    def place(self, message: Message) -> None:
        """Put the robot at a pose (geometry_msgs/PoseWithCovarianceStamped)."""
        try:
            self._localization.set_pose(message, self._now())
        except UnusablePoseError as error:
            refusal = f"set_pose: {error}; it is ignored"
        else:
            return
        self._logger.error(refusal)

    def _set_pose(self, request: Request, response: Response) -> Response:
        self.place(request.pose)
        return response

    def _toggle(self, request: Request, response: Response) -> Response:
        response.status = request.on != self._localization.processing
        if not response.status:
            state = "on" if request.on else "off"
            text = f"toggle: the taking in of measurements is {state} already"
            self._logger.warning(text)
        self._localization.processing = request.on
        return response

    def _reset(self, _request: Request, response: Response) -> Response:
        self._take_in()
        self._localization.reset()
        self._logger.info("the filter starts afresh")
        return response

    def _enable(self, _request: Request, response: Response) -> Response:
        if self._localization.enabled:
            self._logger.warning("the filter is enabled already")
        self._localization.enabled = True
        return response
