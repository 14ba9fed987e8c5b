"""Takes a lifecycle node through one transition.

Its state is asked for first. When that answer has come, the node has discovered every reader that we made before, the
one for its transition events included: discovery tells of readers in the order in which they were made. So no event of
the transition is lost. At the end the state is asked for again, since a response says no more than yes or no.

A transition that the node need not take is done as soon as its state is known.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from lifecycle_msgs.msg import TransitionEvent
from lifecycle_msgs.srv import ChangeState, GetState

from orchestra.ros.observer.order import OFTEN
from orchestra.ros.observer.service import Service
from orchestra.ros.observer.transitions import consequence

if TYPE_CHECKING:
    from rclpy.node import Node

    from orchestra.ros.observer.order import Request, Say


_DEPTH = 100
_ERROR = "errorprocessing"
# The states in which the transitions of lifecycle_msgs/msg/Transition end well, by their ids.
_GOALS = {
    1: "inactive",
    2: "unconfigured",
    3: "active",
    4: "inactive",
    **dict.fromkeys((5, 6, 7), "finalized"),
}


class StateChange:
    """`node` is the full name of the node, `transition` an id of lifecycle_msgs/msg/Transition.

    With `only_in` the node takes it only where it is in that state. `again` says that it may have been asked already.
    """

    every = OFTEN

    def __init__(self, node: Node, request: Request, say: Say) -> None:
        self._say = say
        self._transition: int = request["transition"]
        self._only_in: str | None = request.get("only_in")
        self._again: bool = request.get("again", False)
        self._node = node
        self._erred = False
        # Before the clients: an event that comes while the transition is made must not be lost.
        self._events = node.create_subscription(
            TransitionEvent, f"{request['node']}/transition_event", self._came, _DEPTH
        )
        self._change = Service(node, ChangeState, f"{request['node']}/change_state")
        self._state = Service(node, GetState, f"{request['node']}/get_state")
        self._begun = False

    def look(self) -> None:
        """Begin as soon as the node is there."""
        self._state.look()
        if not self._begun and self._change.ready and self._state.ready:
            self._begun = True
            self._say("asking")
            self._ask_state(self._move)

    def close(self) -> None:
        """Give the clients and the subscription back."""
        self._node.destroy_subscription(self._events)
        self._change.close()
        self._state.close()

    def _ask_state(self, answered: Any) -> None:  # noqa: ANN401 - takes a response of an untyped package
        self._state.ask(GetState.Request(), answered, repeat=True)

    def _move(self, before: Any) -> None:  # noqa: ANN401 - as above
        state = before.current_state.label
        if self._needless(state):
            self._say("done", state=state)
            return
        self._erred = False
        request = ChangeState.Request()
        request.transition.id = self._transition
        self._change.ask(request, partial(self._moved, state))

    def _needless(self, state: str) -> bool:
        elsewhere = self._only_in is not None and state != self._only_in
        return elsewhere or (self._again and state == _GOALS.get(self._transition))

    def _moved(self, before: str, response: Any) -> None:  # noqa: ANN401 - as above
        self._ask_state(partial(self._finish, before, success=response.success))

    def _came(self, event: TransitionEvent) -> None:
        self._erred |= event.goal_state.label == _ERROR

    def _finish(self, before: str, after: Any, *, success: bool) -> None:  # noqa: ANN401 - as above
        state = after.current_state.label
        if success:
            self._say("done", state=state)
        elif state == before and self._erred:
            told = f"an error ended the transition, the node has handled it (`on_error`) and is {state} again"
            self._say("impossible", reason=told)
        elif state == before:
            self._say("impossible", reason=f"the node refused it, or failed, and is still {state}")
        else:
            told = f"it failed; the node was {before} and is {state}{consequence(before, state)}"
            self._say("impossible", reason=told)
