"""Knows when all of the graph has been seen.

On this machine, with Fast DDS: when there are as many participants as ports of participants, and the nodes of each are
known. Then what is seen must stay as it is for a moment, because the endpoints of a node are learned one by one. Where
participants on other machines may answer, or with another middleware, the moment is longer, since nothing tells.
"""

from __future__ import annotations

import os
import time
from typing import Any, Final

from orchestra.ros.tools.graph.bare import publishers
from orchestra.ros.tools.graph.deaf import Deaf
from orchestra.ros.tools.graph.ports import own_port, ports_here, widen
from orchestra.ros.tools.graph.rcl import rcl
from orchestra.ros.tools.graph.rollcall import RollCall

# How long what is seen must stay as it is, in seconds: where participants are counted, and where they are not.
_QUIET: Final = 0.1
_QUIET_UNCOUNTED: Final = 0.5
# After this time, a participant that names no node is taken to have none.
_NAMELESS: Final = 2.0
_CALL_AGAIN: Final = 0.4  # and then after twice as long each time
# A machine that has no time for this process has none for the others: so many looks a second are wanted as well, and so
# many that all see the same.
_LOOKS: Final = 16
_ALIKE: Final = 12
# Where meeting all others took longer than usual, so does learning their endpoints; in seconds.
_USUAL, _LONGEST = 0.4, 1.0
_LOOK_AGAIN: Final = 0.03  # a look at 20 nodes takes 2 ms
_REST: Final = 0.005
_DISCOVERY: Final = "ros_discovery_info"  # each participant of ROS publishes there which nodes it has
_UNKNOWN: Final = "_NODE_NAME_UNKNOWN_"
_OF_NODES: Final = ("/parameter_events", "/rosout")
_PREFIX, _HOST = 12, 4


class Counted:
    """Who is there of those who should be, as a node of ours sees it."""

    def __init__(self, node: Any) -> None:  # noqa: ANN401 - of rclpy, or a bare one
        widen()
        self._news(time.monotonic())
        self._node = node
        self._domain = node.context.get_domain_id()
        self._counted = rcl.rclpy_get_rmw_implementation_identifier() == "rmw_fastrtps_cpp"
        alone = os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "").upper() == "LOCALHOST"
        self._quiet = _QUIET if self._counted and alone else _QUIET_UNCOUNTED
        self._seen: Any = None
        self._own = b""
        self._found: frozenset[bytes] = frozenset()
        self._looked = -_LOOK_AGAIN
        self._nobody_missing = False
        self._since = time.monotonic()
        self._alike = 0
        self._began = time.monotonic()
        self._met = False
        self._slowness = 1.0
        self._deaf = Deaf()
        self._call: RollCall | None = None
        self._called = -_CALL_AGAIN
        self._patience = _CALL_AGAIN / 2
        self._nameless: tuple[frozenset[bytes], float] = (frozenset(), 0.0)

    def settled(self, seen: Any) -> bool:  # noqa: ANN401 - whatever is looked for
        """Tell whether nobody is missing, and this has been seen long enough."""
        now = time.monotonic()
        if seen != self._seen:
            self._news(now)
        if seen != self._seen or not self.complete():
            self._seen, self._since, self._alike = seen, now, 0
        self._alike += 1
        quiet = min(self._quiet * self._slowness, _LONGEST)
        return now - self._since >= quiet and self._alike > _ALIKE

    def silent(self, seconds: float) -> bool:
        """Tell whether nothing new has been seen for this time, though it was looked for."""
        looked = not self._counted or self._looks >= _LOOKS * seconds
        return looked and time.monotonic() - self._news_at > seconds

    def _news(self, now: float) -> None:
        self._news_at, self._looks = now, 0

    def complete(self) -> bool:
        """Tell whether nobody is missing; those who are, are asked to name themselves."""
        if not self._counted:
            return True
        now = time.monotonic()
        if now - self._looked >= _LOOK_AGAIN:
            self._looked = now
            self._looks += 1
            self._nobody_missing = self._look(now)
            if self._nobody_missing and not self._met:
                self._met = True
                self._slowness = max((now - self._began) / _USUAL, 1.0)
        return self._nobody_missing

    def stopped(self) -> frozenset[int]:
        """Return the processes that have not answered because they are stopped."""
        return self._deaf.stopped

    @staticmethod
    def rest() -> None:
        """Let a moment pass in which something new may come."""
        time.sleep(_REST)

    def _look(self, now: float) -> bool:
        if not self._own:
            self._own = self._identity()
            if not self._own:
                return False
        ports = ports_here(self._domain)
        found = self._participants()
        if found != self._found:
            self._found = found
            self._news(now)
        here = len({one for one in found if one[:_HOST] == self._own[:_HOST]})
        if here < len(ports) and here + len(self._deaf.among(ports)) < len(ports):
            self._call_missing(ports, now)
            return False
        self.close()
        nameless = frozenset(found - self._named())
        if nameless != self._nameless[0]:
            self._nameless = (nameless, now)
            self._news(now)
        return not nameless or now - self._nameless[1] > _NAMELESS

    def close(self) -> None:
        """End the roll call."""
        if self._call is not None:
            self._call.close()
            self._call = None

    def _call_missing(self, ports: dict[int, str], now: float) -> None:
        port = own_port(ports)
        if port is None or now - self._called < self._patience:
            return
        self._patience *= 2
        if self._call is not None:
            self._call.close()
        self._call, self._called = RollCall(self._own[:_HOST], port), now
        self._call.call(one for one in ports if one != port)

    def _participants(self) -> frozenset[bytes]:
        """Return the identities of the participants of which endpoints are known."""
        endpoints = publishers(self._node, _DISCOVERY, of_middleware=True)
        return frozenset(endpoint.endpoint_gid[:_PREFIX] for endpoint in endpoints)

    def _named(self) -> frozenset[bytes]:
        """Return those of which nodes are known."""
        named: set[bytes] = set()
        for topic in _OF_NODES:
            if not self._found <= named:
                known = (one for one in publishers(self._node, topic) if one.node_name != _UNKNOWN)
                named.update(one.endpoint_gid[:_PREFIX] for one in known)
        return frozenset(named)

    def _identity(self) -> bytes:
        """Return our own identity, nothing until it is known."""
        for topic in _OF_NODES:
            for endpoint in publishers(self._node, topic):
                if endpoint.node_name == self._node.get_name():
                    return endpoint.endpoint_gid[:_PREFIX]
        return b""
