"""The services of the simulation: reset, pause, step, teleport and set_speed, below the node's name."""

from __future__ import annotations

from concurrent.futures import CancelledError, Future
from typing import TYPE_CHECKING, Any

from rclpy.parameter import Parameter
from std_srvs.srv import SetBool, Trigger

from bringup.world import messages
from bringup.world.geometry import Pose
from bringup.world.interfaces import SetSpeed, Step, Teleport
from bringup.world.layout import LayoutError

if TYPE_CHECKING:
    from rclpy.node import Node

    from bringup.world.course import Course
    from bringup.world.orders import Orders

OVER = "the simulation ends"
MOST_TICKS = 10**6


class Services:
    """What can be asked of the simulation; answered in the thread that serves the node."""

    def __init__(self, node: Node, course: Course, orders: Orders) -> None:
        self._node, self._course, self._orders = node, course, orders
        node.create_service(Trigger, "~/reset", self._reset)
        node.create_service(SetBool, "~/pause", self._pause)
        node.create_service(Step, "~/step", self._step)
        node.create_service(Teleport, "~/teleport", self._teleport)
        node.create_service(SetSpeed, "~/set_speed", self._set_speed)

    def _reset(self, _request: Any, response: Any) -> Any:  # noqa: ANN401 - services have no types
        def reset(done: Future[None]) -> None:
            self._course.reset()
            done.set_result(None)

        try:
            self._orders.ask(reset)
        except CancelledError:
            return _refused(response, OVER)
        response.success = True
        response.message = "all robots are where they started, at time 0"
        return response

    def _pause(self, request: Any, response: Any) -> Any:  # noqa: ANN401 - as above
        return self._set(response, "paused", request.data)

    def _set_speed(self, request: Any, response: Any) -> Any:  # noqa: ANN401 - as above
        return self._set(response, "speed", request.speed)

    def _step(self, request: Any, response: Any) -> Any:  # noqa: ANN401 - as above
        if not 0 < request.ticks <= MOST_TICKS:
            return _refused(response, f"a step has 1 to {MOST_TICKS} ticks, not {request.ticks}")
        self._set(response, "paused", value=True)

        def step(done: Future[int]) -> None:
            self._course.step(request.ticks, done)

        try:
            ticks = self._orders.ask(step)
        except CancelledError:
            return _refused(response, OVER)
        messages.stamp(response.time, ticks)
        response.success, response.message = True, ""
        return response

    def _teleport(self, request: Any, response: Any) -> Any:  # noqa: ANN401 - as above
        def teleport(done: Future[str]) -> None:
            try:
                self._course.teleport(request.robot, Pose(request.x, request.y, request.yaw))
            except LayoutError as error:
                done.set_result(str(error))
            else:
                done.set_result("")

        try:
            reason = self._orders.ask(teleport)
        except CancelledError:
            reason = OVER
        response.success, response.message = not reason, reason
        return response

    def _set(self, response: Any, name: str, value: bool | float) -> Any:  # noqa: ANN401 - as above
        result = self._node.set_parameters([Parameter(name, value=value)])[0]
        response.success, response.message = result.successful, result.reason
        return response


def _refused(response: Any, reason: str) -> Any:  # noqa: ANN401 - as above
    response.success, response.message = False, reason
    return response
