"""A lifecycle node is in a state, or has been in it for a moment since we listen.

Transition events are subscribed to before the state is asked for: when the answer has come, the node has discovered
every reader that was made before, so no later event is missed, and what happened earlier is in the answer. The state is
asked for again now and then: the node may be another one by then, started anew.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from lifecycle_msgs.msg import TransitionEvent
from lifecycle_msgs.srv import GetState

from orchestra.ros.observer.order import OFTEN
from orchestra.ros.observer.service import OwnService

if TYPE_CHECKING:
    from rclpy.node import Node

    from orchestra.ros.observer.order import Request, Say

_DEPTH = 100
# In seconds.
_ASK_ANEW = 1.0


class StateReached:
    """`node` is the full name of the node, `state` the label of a state, such as `active`."""

    def __init__(self, node: Node, request: Request, say: Say) -> None:
        self._node = node
        self._say = say
        self._state: str = request["state"]
        self._subscription = node.create_subscription(
            TransitionEvent, f"{request['node']}/transition_event", self._moved, _DEPTH
        )
        self._service = OwnService(node, GetState, f"{request['node']}/get_state")
        self._ask_at = 0.0
        self.every: float | None = OFTEN

    def look(self) -> None:
        """Ask for the state where it is time."""
        if self._service.asked:
            self._service.look()
        elif self._service.ready and time.monotonic() >= self._ask_at:
            self._service.ask(GetState.Request(), self._answered, repeat=True)

    def close(self) -> None:
        """Give the client and the subscription back."""
        self._service.close()
        self._node.destroy_subscription(self._subscription)

    def _answered(self, response: Any) -> None:  # noqa: ANN401 - of an untyped package
        self._ask_at = time.monotonic() + _ASK_ANEW
        self._is_in(response.current_state.label)

    def _moved(self, event: TransitionEvent) -> None:
        self._is_in(event.goal_state.label)

    def _is_in(self, state: str) -> None:
        if self.every and state == self._state:
            self.every = None
            self._say("done")
