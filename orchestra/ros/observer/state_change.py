"""Takes a lifecycle node through one transition.

Its state is asked for first. When that answer has come, the node knows the reader of its transition events too
(`peer`), so no event of the transition is lost. At the end the state is asked for again, since a response says no more
than yes or no.

A transition that the node need not take is done as soon as its state is known. Where no answer comes the state tells
whether the node has been reached at all: if it still is as it was, it is asked once more. A node that is at it does not
say so: it tells a state on the way, or nothing.
"""

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING, Any

from lifecycle_msgs.srv import ChangeState, GetState

from orchestra.ros.observer.order import OFTEN
from orchestra.ros.observer.peer import peers_of
from orchestra.ros.observer.transitions import consequence

if TYPE_CHECKING:
    from lifecycle_msgs.msg import TransitionEvent
    from rclpy.node import Node

    from orchestra.ros.observer.order import Request, Say


# Without an answer we doubt that the node was reached after so long, in seconds, then after twice as long each time.
_DOUBT_AFTER = 0.3
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
        self._erred = False
        self._peers = peers_of(node)
        self._name = request["node"]
        self._peer = self._peers.join(self._name)
        self._peer.listeners.add(self._came)
        self._change, self._state = self._peer.services()
        self._begun = False
        self._before = ""
        self._asked = 0
        self._doubt_at: float | None = None

    def look(self) -> None:
        """Begin as soon as the node is there."""
        self._state.look()
        if not self._begun and self._change.ready and self._state.ready:
            self._begun = True
            self._say("asking")
            self._ask_state(self._move)
        elif self._doubt_at is not None and time.monotonic() >= self._doubt_at and not self._state.asked:
            self._ask_state(self._reconsider)

    def close(self) -> None:
        """Neither ask nor listen any more."""
        self._change.close()
        self._state.close()
        self._peer.listeners.discard(self._came)
        self._peers.leave(self._name)

    def _ask_state(self, answered: Any) -> None:  # noqa: ANN401 - takes a response of an untyped package
        self._state.ask(GetState.Request(), answered, repeat=True)

    def _move(self, before: Any) -> None:  # noqa: ANN401 - as above
        state = before.current_state.label
        if self._needless(state):
            self._say("done", state=state)
            return
        self._before = state
        self._erred = False
        self._ask_change()

    def _ask_change(self) -> None:
        request = ChangeState.Request()
        request.transition.id = self._transition
        self._doubt_at = time.monotonic() + _DOUBT_AFTER * 2**self._asked
        self._asked += 1
        self._change.ask(request, self._moved)

    def _reconsider(self, now: Any) -> None:  # noqa: ANN401 - as above
        """No answer has come so far: it was lost, or the question was, or the node is at it."""
        state = now.current_state.label
        if self._doubt_at is None:
            return
        if state == _GOALS.get(self._transition):
            self._say("done", state=state)
        elif state == self._before:
            self._ask_change()
        else:
            self._doubt_at = time.monotonic() + _DOUBT_AFTER

    def _needless(self, state: str) -> bool:
        elsewhere = self._only_in is not None and state != self._only_in
        return elsewhere or (self._again and state == _GOALS.get(self._transition))

    def _moved(self, response: Any) -> None:  # noqa: ANN401 - as above
        self._doubt_at = None
        self._ask_state(partial(self._finish, success=response.success))

    def _came(self, event: TransitionEvent) -> None:
        self._erred |= event.goal_state.label == _ERROR

    def _finish(self, after: Any, *, success: bool) -> None:  # noqa: ANN401 - as above
        state, before = after.current_state.label, self._before
        # Asked twice, a node has to say no once.
        if success or (self._asked > 1 and state == _GOALS.get(self._transition)):
            self._say("done", state=state)
        elif state == before and self._erred:
            told = f"an error ended the transition, the node has handled it (`on_error`) and is {state} again"
            self._say("impossible", reason=told)
        elif state == before:
            self._say("impossible", reason=f"the node refused it, or failed, and is still {state}")
        else:
            told = f"it failed; the node was {before} and is {state}{consequence(before, state)}"
            self._say("impossible", reason=told)
