"""A lifecycle node as we know it: the reader of its transition events, and the clients that change and tell its state.

All of it is kept for a while after the last order that needed it. What is new has to be discovered by the node first.
That takes some milliseconds, but 3 s where a message of the discovery is lost (the period of Fast DDS's heartbeats for
it), and a node that is to be deactivated at its end has less time. Through what it has answered once it is reached.
"""

from __future__ import annotations

import time
from functools import cache
from typing import TYPE_CHECKING

from lifecycle_msgs.msg import TransitionEvent
from lifecycle_msgs.srv import ChangeState, GetState

from orchestra.ros.observer.service import Service

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.client import Client
    from rclpy.node import Node

    Listener = Callable[[TransitionEvent], None]

_DEPTH = 100
# For how long what nobody uses is kept, in seconds. It is looked at when a peer is asked for or left, never by a timer.
_KEPT_FOR = 10.0


class Peer:
    """`name` is the full name of the lifecycle node. `listeners` hear its transition events.

    The reader is made before the clients, and is as old as they are: discovery tells of them in the order in which they
    were made, so a node that has answered knows that we listen.
    """

    def __init__(self, node: Node, name: str) -> None:
        self.listeners: set[Listener] = set()
        self._node = node
        self._name = name
        self._events = node.create_subscription(
            TransitionEvent, f"{name}/transition_event", self._came, _DEPTH
        )
        self._clients: tuple[Client, Client] | None = None

    def services(self) -> tuple[Service, Service]:
        """Return what changes its state, and what tells it."""
        change, state = self.clients()
        return Service(change), Service(state)

    def clients(self) -> tuple[Client, Client]:
        """Return the clients of these services; those who only listen need none."""
        if self._clients is None:
            self._clients = (
                self._node.create_client(ChangeState, f"{self._name}/change_state"),
                self._node.create_client(GetState, f"{self._name}/get_state"),
            )
        return self._clients

    def close(self) -> None:
        """Give all of it back."""
        self._node.destroy_subscription(self._events)
        for client in self._clients or ():
            self._node.destroy_client(client)

    def _came(self, event: TransitionEvent) -> None:
        for listener in [*self.listeners]:
            listener(event)


class Peers:
    """The peers of a node of ours, each there once. Whoever joins one has to leave it."""

    def __init__(self, node: Node, clock: Callable[[], float] = time.monotonic) -> None:
        self._node = node
        self._clock = clock
        self._there: dict[str, Peer] = {}
        self._users: dict[str, int] = {}
        self._left_at: dict[str, float] = {}

    def join(self, name: str) -> Peer:
        """Return the peer of that full name."""
        self._give_up()
        self._left_at.pop(name, None)
        if name not in self._there:
            self._there[name] = Peer(self._node, name)
        self._users[name] = self._users.get(name, 0) + 1
        return self._there[name]

    def leave(self, name: str) -> None:
        """Tell that one of its users needs it no more."""
        self._users[name] -= 1
        if not self._users[name]:
            self._left_at[name] = self._clock()
        self._give_up()

    def _give_up(self) -> None:
        before = self._clock() - _KEPT_FOR
        for name in [name for name, left_at in self._left_at.items() if left_at <= before]:
            del self._left_at[name], self._users[name]
            self._there.pop(name).close()


@cache
def peers_of(node: Node) -> Peers:
    """Return the peers of a node of ours, always the same; the observer has one node, as long as it lives."""
    return Peers(node)
