"""What a node of rclpy is for the commands that look, without being one: it is in nobody's graph."""

from __future__ import annotations

import re
import time
from functools import cached_property
from typing import TYPE_CHECKING, Any, Final

from orchestra.ros.tools.graph.wire.endpoints import Endpoints
from orchestra.ros.tools.graph.wire.names import Names

if TYPE_CHECKING:
    from orchestra.ros.tools.graph.wire.client import Client
    from orchestra.ros.tools.graph.wire.ends import WireEnd

    Listed = list[tuple[str, list[str]]]

_NAME: Final = re.compile(r"(/[A-Za-z_][A-Za-z0-9_]*)+")
_LOOKS: Final = 16  # a second, without which nothing can be said to be silent
_STEP: Final = 0.005
_MET: Final = 3


class WireNode:
    """Asks the participants of this machine for what it is asked for, when it is asked for it."""

    def __init__(self, domain: int, name: str) -> None:
        self._domain = domain
        self._name = name
        self._asked: list[Names | Endpoints] = []
        self._clients: list[Client] = []
        self._looks = 0
        self._looks_from = time.monotonic()

    @cached_property
    def _names(self) -> Names:
        self._asked.append(names := Names(self._domain))
        return names

    @cached_property
    def _endpoints(self) -> Endpoints:
        self._asked.append(endpoints := Endpoints(self._domain))
        return endpoints

    def get_name(self) -> str:
        """Return the name that nobody has."""
        return self._name

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """Return the nodes."""
        return [(node.name, node.space) for node in self._names.nodes()]

    def get_topic_names_and_types(self) -> Listed:
        """Return the topics."""
        return self._endpoints.topics()

    def get_service_names_and_types(self) -> Listed:
        """Return the services."""
        return self._endpoints.services()

    def count_publishers(self, topic: str) -> int:
        """Return how many publishers a topic has."""
        return self._endpoints.count(f"rt{_checked(topic)}", writing=True)

    def count_subscribers(self, topic: str) -> int:
        """Return how many subscriptions a topic has."""
        return self._endpoints.count(f"rt{_checked(topic)}", writing=False)

    def count_services(self, service: str) -> int:
        """Return how many servers a service has."""
        return self._endpoints.count(f"rq{_checked(service, service=True)}Request", writing=False)

    def count_clients(self, service: str) -> int:
        """Return how many clients a service has."""
        return self._endpoints.count(f"rr{_checked(service, service=True)}Reply", writing=False)

    def get_publishers_info_by_topic(self, topic: str) -> list[WireEnd]:
        """Return the publishers of a topic."""
        return self._ends(topic, writing=True)

    def get_subscriptions_info_by_topic(self, topic: str) -> list[WireEnd]:
        """Return the subscriptions of a topic."""
        return self._ends(topic, writing=False)

    def get_publisher_names_and_types_by_node(self, name: str, space: str) -> Listed:
        """Return the topics on which a node publishes."""
        return self._endpoints.topics(self._of(name, space), writing=True)

    def get_subscriber_names_and_types_by_node(self, name: str, space: str) -> Listed:
        """Return the topics that a node hears."""
        return self._endpoints.topics(self._of(name, space), writing=False)

    def get_service_names_and_types_by_node(self, name: str, space: str) -> Listed:
        """Return the services that a node has."""
        return self._endpoints.services(self._of(name, space), serving=True)

    def get_client_names_and_types_by_node(self, name: str, space: str) -> Listed:
        """Return the services of which a node has clients."""
        return self._endpoints.services(self._of(name, space), serving=False)

    def _of(self, name: str, space: str) -> frozenset[bytes]:
        """Return the identities of the endpoints of a node; where several have the name, of the first of them."""
        found = [node for node in self._names.nodes() if (node.name, node.space) == (name, space)]
        return found[0].readers | found[0].writers if found else frozenset()

    def _ends(self, topic: str, *, writing: bool) -> list[WireEnd]:
        from orchestra.ros.tools.graph.wire.ends import end_of  # noqa: PLC0415 - most commands do without

        nodes = {
            gid: node for node in self._names.nodes() for gid in (node.writers if writing else node.readers)
        }
        found = self._endpoints.ends(f"rt{_checked(topic)}", writing=writing)
        return [end_of(one, nodes.get(one.guid)) for one in found]

    def create_client(self, kind: Any, name: str) -> Client:  # noqa: ANN401 - a class of an untyped package
        """Return a client of a service."""
        from orchestra.ros.tools.graph.wire.client import Client  # noqa: PLC0415 - coders, and lists need none

        client = Client(self._domain, kind, _checked(name, service=True))
        self._clients.append(client)
        return client

    def destroy_client(self, client: Client) -> None:
        """Give a client back."""
        self._clients.remove(client)
        client.close()

    def hear(self, seconds: float) -> None:
        """Let what has come in be heard, and wait for it at most so long."""
        self._looks += 1
        members = [one.member for one in (*self._asked, *self._clients)]
        if not members:
            time.sleep(seconds)
        for member in members:
            member.hear(seconds if member is members[-1] else 0)
        for client in self._clients:
            client.speak()

    def complete(self) -> bool:
        """Tell whether all that was asked for is known."""
        return all(one.complete() for one in self._asked)

    def settled(self, _seen: Any) -> bool:  # noqa: ANN401 - whatever is looked for
        """Tell whether all that was asked for was known when this was seen."""
        return self.complete()

    def silent(self, seconds: float) -> bool:
        """Tell whether nothing new has come for this time, though it was listened."""
        news_at = max((one.member.news_at for one in self._asked), default=self._looks_from)
        if news_at > self._looks_from:
            self._looks_from, self._looks = news_at, 0
        if all(one.member.met() for one in self._asked):
            seconds *= _MET  # they are there, and only slow
        return self._looks >= _LOOKS * seconds and time.monotonic() - self._looks_from > seconds

    def stopped(self) -> frozenset[int]:
        """Return the processes that have not answered because they are stopped."""
        return frozenset[int]().union(*(one.member.deaf.stopped for one in self._asked))

    def rest(self) -> None:
        """Let a moment pass in which something may come."""
        self.hear(_STEP)

    def close(self) -> None:
        """Do nothing: there is nobody who keeps anything for us, but for `destroy_node`."""

    def destroy_node(self) -> None:
        """Leave."""
        for client in self._clients.copy():
            self.destroy_client(client)
        for one in self._asked:
            one.member.close()


def _checked(name: str, *, service: bool = False) -> str:
    """Return a full name. Raises `RunError` for what is none, as a node of rclpy does."""
    if not _NAME.fullmatch(name):
        from orchestra.ros.tools.graph.bare import refuse  # noqa: PLC0415 - rclpy, and only for a mistake

        refuse(name, service=service)
    return name
