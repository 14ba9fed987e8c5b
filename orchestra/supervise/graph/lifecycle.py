"""Lifecycle nodes (the ROS 2 design "Managed nodes"): takes them through transitions, and hears of their transitions.

Each node has a queue of its own, so nodes move at the same time and one that hangs holds up nobody else. Orders for a
node that has not appeared wait for it; those for one that goes away end with it.
"""

from __future__ import annotations

from collections import deque
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

from orchestra.logs.names import shown
from orchestra.supervise.graph.orders import Order
from orchestra.supervise.reactions.happening import state_changed

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping

    from orchestra.supervise.graph.orders import Orders, Refusal
    from orchestra.supervise.reactions.happening import Happening
    from orchestra.supervise.surroundings import Surroundings

# lifecycle_msgs/msg/Transition
CONFIGURE, CLEAN_UP, ACTIVATE, DEACTIVATE = 1, 2, 3, 4
_SHUT_DOWN = (5, 6, 7)
TO_ACTIVE = (CONFIGURE, ACTIVATE)
_LABELS = {
    CONFIGURE: "configure",
    CLEAN_UP: "clean up",
    ACTIVATE: "activate",
    DEACTIVATE: "deactivate",
    **dict.fromkeys(_SHUT_DOWN, "shut down"),
}


class Node(NamedTuple):
    """A node that is there: its id in the plan, its full name, an environment that sees it, the pid of its process."""

    id: str
    name: str
    environment: Mapping[str, str]
    pid: int | None


class LifecycleNodes:
    """Moves lifecycle nodes.

    `happened` hears of transitions, `entered` of the states that our own led to, `went_wrong` of those that failed, in
    words.
    """

    def __init__(
        self,
        orders: Orders,
        surroundings: Surroundings,
        happened: Callable[[Happening], None],
        entered: Callable[[Node, str], None],
        went_wrong: Callable[[str], None],
    ) -> None:
        self._orders = orders
        self._around = surroundings
        self._happened = happened
        self._entered = entered
        self._went_wrong = went_wrong
        self._nodes: dict[str, Node] = {}
        self._todo: dict[str, deque[tuple[int, ...]]] = {}
        self._moving: set[str] = set()
        self._watched: set[str] = set()
        self._stopped = False

    @property
    def moving(self) -> bool:
        """Whether an answer of a node is awaited."""
        return bool(self._moving)

    def appeared(self, node: Node, *, watched: bool) -> None:
        """A node is there, or its process at least; `watched` wants to hear of its transitions."""
        if self._stopped:
            return
        self._nodes[node.id] = node
        if watched:
            self.watch(node.id)
        self._go_on(node.id)

    def watch(self, name: str) -> None:
        """Listen for the transitions of a node that is there."""
        node = self._nodes.get(name)
        if node is None or name in self._watched:
            return
        self._watched.add(name)
        self._around.observers.order(
            _watch(name),
            {"do": "transitions", "node": node.name},
            node.environment,
            partial(self._heard, node),
        )

    def disappeared(self, name: str, reason: str) -> None:
        """A node has gone; what it should still do fails for that reason."""
        node = self._nodes.pop(name, None)
        if node is None:
            return
        if name in self._watched:
            self._watched.discard(name)
            self._around.observers.forget(_watch(name))
        self._withdraw(name)
        for transitions in self._todo.pop(name, ()):
            self._failed(name, transitions[0], reason)

    def change(self, name: str, transitions: tuple[int, ...]) -> None:
        """Take a node through transitions, in order, as soon as it is there; it stops where one fails."""
        if transitions and not self._stopped:
            self._todo.setdefault(name, deque()).append(transitions)
            self._go_on(name)

    def never(self, names: Collection[str], reason: str) -> None:
        """These nodes will not appear: what waits for them fails."""
        for name in [name for name in self._todo if name in names and name not in self._nodes]:
            for transitions in self._todo.pop(name):
                self._failed(name, transitions[0], reason)

    def release(self, name: str) -> None:
        """A node is being ended: nothing is asked of it any more, and that is no failure."""
        self._todo.pop(name, None)
        self._withdraw(name)

    def stop(self) -> None:
        """The run ends: nothing is asked of nodes any more."""
        self._stopped = True
        for name in [*self._nodes]:
            self.release(name)
            self.disappeared(name, "the run ends")
        self._todo.clear()

    def _withdraw(self, name: str) -> None:
        if name in self._moving:
            self._moving.discard(name)
            self._orders.withdraw(_move(name))

    def _go_on(self, name: str) -> None:
        node, todo = self._nodes.get(name), self._todo.get(name)
        if node is None or not todo or name in self._moving:
            return
        self._moving.add(name)
        transition = todo[0][0]
        message = {"do": "change_state", "node": node.name, "transition": transition}
        order = Order(_move(name), message, f"{node.name}/change_state", node.environment)
        self._orders.give(
            order, partial(self._moved, name, transition), partial(self._refused, name, transition)
        )

    def _moved(self, name: str, transition: int, message: dict[str, Any]) -> None:
        self._moving.discard(name)
        self._around.recorder.record(
            "transition_done", name, transition=_LABELS.get(transition, transition), state=message["state"]
        )
        self._around.journal.say(f"{shown(name)} is {message['state']}")
        self._entered(self._nodes[name], message["state"])
        todo = self._todo[name]
        rest = todo[0][1:]
        if rest:
            todo[0] = rest
        else:
            todo.popleft()
        self._go_on(name)

    def _refused(self, name: str, transition: int, refusal: Refusal) -> None:
        self._moving.discard(name)
        self._todo[name].popleft()
        self._failed(name, transition, refusal.reason)
        self._go_on(name)

    def _failed(self, name: str, transition: int, reason: str) -> None:
        label = str(_LABELS.get(transition, transition))
        self._around.recorder.record("transition_failed", name, transition=label, reason=reason)
        self._went_wrong(f"{shown(name)} did not {label}: {reason}")

    def _heard(self, node: Node, message: dict[str, Any]) -> None:
        if message["say"] == "impossible":
            self._went_wrong(f"the states of {shown(node.id)} cannot be watched: {message['reason']}")
        if message["say"] != "moved":
            return
        facts = {key: message[key] for key in ("transition", "start_state", "goal_state")}
        self._around.recorder.record("state_changed", node.id, pid=node.pid, **facts)
        self._happened(state_changed(node.id, node.pid, **facts))


def _watch(name: str) -> str:
    return f"transitions of {name}"


def _move(name: str) -> str:
    return f"state of {name}"
