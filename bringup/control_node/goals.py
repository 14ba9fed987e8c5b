"""The action `go_to_goal`: takes goals, drives to one at a time, and tells its client how it goes and how it ended.

A goal that cannot be meant is accepted and aborted at once, since only a result has room for the reason. rclpy's
executor asks a coroutine that waits over and over again, which would keep a processor busy; so nothing waits here:
a goal is executed at its end, by a callback that has its result already.
"""

from __future__ import annotations

import math
from time import monotonic
from typing import TYPE_CHECKING, Any, TypeAlias

from rclpy.action import ActionServer, CancelResponse
from rclpy.impl.implementation_singleton import rclpy_implementation

from bringup.control.journey import Goal
from bringup.control.outcome import Outcome, Result
from bringup.control_node.claims import PATIENCE, Claims
from bringup.control_node.interfaces import GoToGoal
from bringup.control_node.messages import duration, fill_pose, pose_of

if TYPE_CHECKING:
    from rclpy.node import Node

    from bringup.control.controller import Odometry
    from bringup.control.journey import Journey
    from bringup.control.settings import Settings

Handle: TypeAlias = Any
Message: TypeAlias = Any

# The step from accepted to executing, which rclpy itself makes only together with the call of its callback.
EXECUTE = rclpy_implementation.GoalEvent.EXECUTE
# A goal farther away than this (m) is refused: the grid holds the robot and its goal, and planning takes its time.
FARTHEST = 40.0
# Nearer (m, rad) than this to a goal a robot cannot be steered at 10 Hz.
FINEST = 0.02
REPLACED = Result(Outcome.PREEMPTED, "a newer goal has taken its place")
CANCELED = Result(Outcome.CANCELED, "canceled by its client")


class Goals:
    """The server. While one goal is driven to, a newer one may wait for the answer whether its place is free."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._waiting: Handle = None
        self._came = 0.0
        self._asked = False
        self._driving: Handle = None
        self._claims: Claims | None = None
        self._elapsed, self._distance = 0.0, math.nan
        self._feedback = GoToGoal.Feedback()
        self._server = ActionServer(
            node,
            GoToGoal,
            "go_to_goal",
            execute_callback=lambda _: GoToGoal.Result(),
            handle_accepted_callback=self._accept,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
        )

    @property
    def called_off(self) -> Result | None:
        """Why the goal that is driven to is not to be driven to any more, None as long as it is."""
        if self._driving is None:
            return None
        if self._driving.is_cancel_requested:
            return CANCELED
        text = self._claims.late_refusal() if self._claims is not None and self._waiting is None else ""
        return Result(Outcome.OVERRULED, text) if text else None

    def due(self, settings: Settings, odometry: Odometry | None, frame: str) -> Goal | None:
        """The goal to drive to from now on, if one has come and nothing speaks against it; the one before ends."""
        self._connect(settings.claim_service)
        handle = self._waiting
        if handle is None:
            return None
        if self._comes_early(handle, odometry):
            return None
        goal = _goal(handle.request, settings)
        refusal = CANCELED if handle.is_cancel_requested else _objection(handle.request, odometry, frame)
        if refusal is None and (text := self._claimed_by_others(handle.request)) != "":
            if text is None:
                return None
            refusal = Result(Outcome.OVERRULED, text)
        self._waiting = None
        if refusal is not None:
            self._withdraw()
            self._finish(handle, refusal, 0.0, math.nan)
            return None
        self._end_driving(REPLACED)
        self._driving, self._elapsed, self._distance = handle, 0.0, math.nan
        return goal

    def tell(self, now: float, journey: Journey | None, odometry: Odometry | None, frame: str) -> None:
        """Tell the client how it goes, or how it has ended; `now` is in seconds of ROS time."""
        if self._driving is None or journey is None:
            return
        self._elapsed = now - journey.since
        if odometry is not None:
            self._distance = odometry.pose.distance(journey.goal.x, journey.goal.y)
            self._send_feedback(journey, odometry, frame)
        if journey.result is not None:
            self._end_driving(journey.result)
            self._release()

    def end(self, text: str) -> None:
        """End what waits and what is driven to: the robot is not driven any more."""
        result = Result(Outcome.OVERRULED, text)
        if self._waiting is not None:
            self._withdraw()
            self._finish(self._waiting, result, 0.0, math.nan)
            self._waiting = None
        if self._driving is not None:
            self._end_driving(result)
            self._release()

    def close(self) -> None:
        """Leave the graph."""
        self._server.destroy()
        if self._claims is not None:
            self._claims.close()

    def _accept(self, handle: Handle) -> None:
        if self._waiting is not None:
            self._finish(self._waiting, REPLACED, 0.0, math.nan)
        self._waiting, self._asked, self._came = handle, False, monotonic()
        if not handle.is_cancel_requested:
            handle._update_state(EXECUTE)  # noqa: SLF001 - see EXECUTE

    def _comes_early(self, handle: Handle, odometry: Odometry | None) -> bool:
        """Tell whether a goal is to wait for the first odometry: a node that has just begun may not have met it."""
        return odometry is None and not handle.is_cancel_requested and monotonic() - self._came < PATIENCE

    def _connect(self, service: str) -> None:
        """Have the service of claims known before a goal comes: on a busy machine that takes seconds."""
        if self._claims is not None and self._claims.service != service:
            self._claims.close()
            self._claims = None
        if self._claims is None and service:
            self._claims, self._asked = Claims(self._node, service), False

    def _claimed_by_others(self, request: Message) -> str | None:
        """Why the place is taken, '' if it is free, None as long as that is not known."""
        if self._claims is None:
            return ""
        if not self._asked:
            self._asked = True
            self._claims.ask(request.pose)
        return self._claims.refusal()

    def _withdraw(self) -> None:
        if self._claims is not None:
            self._claims.withdraw()

    def _release(self) -> None:
        if self._claims is not None:
            self._claims.release()

    def _end_driving(self, result: Result) -> None:
        if self._driving is not None:
            self._finish(self._driving, result, self._elapsed, self._distance)
            self._driving = None

    def _finish(self, handle: Handle, result: Result, elapsed: float, distance: float) -> None:
        message = GoToGoal.Result(
            outcome=int(result.outcome),
            text=result.text,
            final_distance=distance,
            elapsed=duration(elapsed),
        )

        def finished(handle: Handle) -> Message:
            if result.outcome is Outcome.REACHED:
                handle.succeed()
            elif handle.is_cancel_requested:
                handle.canceled()
            else:
                handle.abort()
            return message

        self._node.get_logger().info(f"goal: {result.outcome.name.lower()}: {result.text}")
        self._server.notify_execute(handle, finished)

    def _send_feedback(self, journey: Journey, odometry: Odometry, frame: str) -> None:
        message = self._feedback
        message.pose.header.stamp = self._node.get_clock().now().to_msg()
        message.pose.header.frame_id = frame
        fill_pose(message.pose.pose, odometry.pose)
        left = self._distance if math.isnan(journey.left) else journey.left
        message.distance_remaining = left
        message.elapsed = duration(self._elapsed)
        self._driving.publish_feedback(message)


def _goal(request: Message, settings: Settings) -> Goal:
    """What a request means with these settings; a pose that is no numbers is objected to elsewhere."""
    position = request.pose.pose.position
    pose = pose_of(request.pose.pose)
    return Goal(
        position.x,
        position.y,
        0.0 if pose is None else pose.yaw,
        request.xy_tolerance or settings.goal_tolerance,
        request.yaw_tolerance or settings.goal_yaw_tolerance,
        request.timeout or settings.goal_timeout,
    )


def _objection(request: Message, odometry: Odometry | None, frame: str) -> Result | None:
    """Why this cannot be driven to, or None."""
    if odometry is None:
        return Result(Outcome.LOST, "no odometry: where the robot is is not known")
    given = request.pose.header.frame_id
    if given.lstrip("/") != frame.lstrip("/"):
        named = f"in frame '{given}'" if given else "in no frame"
        return Result(Outcome.REFUSED, f"the goal is {named}, this robot knows where it is in '{frame}'")
    pose = pose_of(request.pose.pose)
    if pose is None:
        return Result(Outcome.REFUSED, "the goal's pose is no numbers")
    for name in ("xy_tolerance", "yaw_tolerance", "timeout"):
        value = getattr(request, name)
        if not (math.isfinite(value) and value >= 0.0):
            return Result(Outcome.REFUSED, f"{name} is {value:g}, must be a number of 0 or more")
    for name in ("xy_tolerance", "yaw_tolerance"):
        value = getattr(request, name)
        if 0.0 < value < FINEST:
            return Result(Outcome.REFUSED, f"{name} is {value:g}, must be 0 or at least {FINEST:g}")
    if odometry.pose.distance(pose.x, pose.y) > FARTHEST:
        return Result(Outcome.REFUSED, f"the goal is more than {FARTHEST:g} m away")
    return None
