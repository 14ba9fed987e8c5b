"""`action send_goal`."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any, Final

from action_msgs.msg import GoalStatus
from rclpy.action import ActionClient

from orchestra.errors import RunError
from orchestra.ros.tools.graph.action_names import actions
from orchestra.ros.tools.graph.asking import Deadline, wait_for_server
from orchestra.ros.tools.graph.joining import joined
from orchestra.ros.tools.graph.names import NO_ACTION, absolute, unknown
from orchestra.ros.tools.messages.plain import plain
from orchestra.ros.tools.messages.reading import fill_from
from orchestra.ros.tools.messages.text import yaml_text
from orchestra.ros.tools.messages.types import action_class
from orchestra.ros.tools.telling import as_json, json_line

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.ros.tools.graph.seeing import Graph

_STATES: Final = {
    GoalStatus.STATUS_UNKNOWN: "UNKNOWN",
    GoalStatus.STATUS_ACCEPTED: "ACCEPTED",
    GoalStatus.STATUS_EXECUTING: "EXECUTING",
    GoalStatus.STATUS_CANCELING: "CANCELING",
    GoalStatus.STATUS_SUCCEEDED: "SUCCEEDED",
    GoalStatus.STATUS_CANCELED: "CANCELED",
    GoalStatus.STATUS_ABORTED: "ABORTED",
}
_CANCEL_WITHIN: Final = 5.0


def send_goal(options: Namespace) -> int:
    """Send a goal to an action, and write what becomes of it."""
    name, kind = absolute(options.action), action_class(options.type)
    goal = kind.Goal()
    fill_from(sys.stdin.read() if options.stdin else options.goal, goal)
    deadline = Deadline(options.timeout)
    with joined(options) as graph:
        client = ActionClient(graph.node, kind, name)
        try:
            return _Pursuit(graph, client, options, deadline).follow(name, goal)
        finally:
            client.destroy()


class _Pursuit:
    """One goal, from its sending to its end."""

    def __init__(self, graph: Graph, client: ActionClient, options: Namespace, deadline: Deadline) -> None:
        self._graph = graph
        self._client = client
        self._options = options
        self._deadline = deadline

    def follow(self, name: str, goal: Any) -> int:  # noqa: ANN401 - of an untyped package
        """Send the goal, and return the exit status when it is reached or not."""
        self._say("Waiting for an action server to become available...\n")
        graph = self._graph
        if not wait_for_server(
            graph, name, self._client.server_is_ready, lambda: actions(graph), self._deadline
        ):
            known = {other for other, _ in actions(self._graph)} - {name}  # which our client has made known
            raise unknown(NO_ACTION, name, known)
        self._say(f"Sending goal:\n     {yaml_text(plain(goal))}\n", {"goal": plain(goal)})
        sent = self._client.send_goal_async(goal, self._heard)
        try:
            handle = self._done(sent, "the server did not answer the goal")
        except BaseException:
            # It may be on its way to the server, which would go after it.
            if self._graph.wait(sent.done, _CANCEL_WITHIN) and sent.result().accepted:
                self._cancel(sent.result())
            raise
        if not handle.accepted:
            self._say("Goal was rejected.\n", {"status": "REJECTED"})
            return 1
        number = bytes(handle.goal_id.uuid).hex()
        self._say(f"Goal accepted with ID: {number}\n\n", {"accepted": number})
        try:
            result = self._done(handle.get_result_async(), "the goal was not reached")
        except BaseException:
            self._cancel(handle)
            raise
        status = _STATES.get(result.status, str(result.status))
        told = plain(result.result)
        self._say(f"Result:\n    {yaml_text(told)}\n", {"result": told})
        self._say(f"Goal finished with status: {status}\n", {"status": status})
        return 0 if result.status == GoalStatus.STATUS_SUCCEEDED else 1

    def _heard(self, message: Any) -> None:  # noqa: ANN401 - as above
        if self._options.feedback:
            told = plain(message.feedback)
            self._say(f"Feedback:\n    {yaml_text(told)}\n", {"feedback": told})

    def _done(self, future: Any, else_: str) -> Any:  # noqa: ANN401 - as above
        if not self._graph.wait(future.done, self._deadline.left):
            raise RunError(f"{else_} within {self._deadline}")
        return future.result()

    def _cancel(self, handle: Any) -> None:  # noqa: ANN401 - as above
        """Take a goal back that nobody waits for any more."""
        self._say("Canceling goal...\n")
        cancelled = handle.cancel_goal_async()
        if self._graph.wait(cancelled.done, _CANCEL_WITHIN) and cancelled.result().goals_canceling:
            self._say("Goal canceled.\n", {"status": "CANCELED"})

    def _say(self, text: str, data: Any = None) -> None:  # noqa: ANN401 - JSON data
        if not as_json(self._options):
            sys.stdout.write(text)
        elif data is not None:
            sys.stdout.write(json_line(data))
        sys.stdout.flush()
