"""A node with nothing but what rcl gives it: no parameters, no services, no clock, and none of the modules for them.

It looks at the graph and calls services, under the names that rclpy's node has for it.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, Final

from orchestra.dataclass import dataclass
from orchestra.errors import RunError
from orchestra.ros.tools.graph.rcl import rcl
from orchestra.ros.tools.graph.reply import Reply

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    Names = list[tuple[str, list[str]]]

_SERVICES: Final = "qos_profile_services_default"
_NANOSECONDS: Final = 1e9


@dataclass(frozen=True, slots=True)
class Endpoint:
    """A publisher or a subscription of the graph."""

    node_name: str
    node_namespace: str
    endpoint_gid: bytes


class BareContext:
    """What rclpy's context is for its node. Raises `RuntimeError` where rcl cannot be started."""

    def __init__(self, arguments: Sequence[str]) -> None:
        self.handle = rcl.Context(list(arguments), rcl.RCL_DEFAULT_DOMAIN_ID)
        rcl.rclpy_logging_configure(self.handle)

    def get_domain_id(self) -> int:
        """Return the number of the domain."""
        with self.handle:
            return int(self.handle.get_domain_id())

    def close(self) -> None:
        """Give everything back."""
        with self.handle:
            self.handle.shutdown()
        rcl.rclpy_logging_fini()
        self.handle.destroy_when_not_in_use()


class BareNode:
    """The node. It publishes what it logs, as every node does: by that it knows itself in the graph."""

    def __init__(self, name: str, context: BareContext) -> None:
        self.context = context
        self._name = name
        self._clients: list[BareClient] = []
        with context.handle:
            self.handle = rcl.Node(name, "", context.handle, [], True, True)

    def get_name(self) -> str:
        """Return its name."""
        return self._name

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """Return the nodes."""
        with self.handle:
            return list(self.handle.get_node_names_and_namespaces())

    def get_topic_names_and_types(self) -> Names:
        """Return the topics."""
        with self.handle:
            return list(rcl.rclpy_get_topic_names_and_types(self.handle, False))

    def get_service_names_and_types(self) -> Names:
        """Return the services."""
        with self.handle:
            return list(rcl.rclpy_get_service_names_and_types(self.handle))

    def get_publishers_info_by_topic(self, topic: str) -> list[Endpoint]:
        """Return the publishers of a topic."""
        return publishers(self, topic)

    def get_subscriptions_info_by_topic(self, topic: str) -> list[Endpoint]:
        """Return the subscriptions of a topic."""
        return subscriptions(self, topic)

    def count_publishers(self, topic: str) -> int:
        """Return how many publishers a topic has."""
        return _counted(self.handle.get_count_publishers, topic, service=False)

    def count_subscribers(self, topic: str) -> int:
        """Return how many subscriptions a topic has."""
        return _counted(self.handle.get_count_subscribers, topic, service=False)

    def count_services(self, service: str) -> int:
        """Return how many servers a service has."""
        return _counted(self.handle.get_count_services, service, service=True)

    def count_clients(self, service: str) -> int:
        """Return how many clients a service has."""
        return _counted(self.handle.get_count_clients, service, service=True)

    def create_client(self, kind: Any, name: str) -> BareClient:  # noqa: ANN401 - a class of an untyped package
        """Return a client of a service. Raises `ValueError` where its libraries are not to be found."""
        client = BareClient(self, kind, name)
        self._clients.append(client)
        return client

    def destroy_client(self, client: BareClient) -> None:
        """Give a client back."""
        self._clients.remove(client)
        client.handle.destroy_when_not_in_use()

    def hear(self, seconds: float) -> None:
        """Wait at most so long for answers, and hand them over."""
        if not self._clients:  # rcl takes it for a mistake to wait for nothing
            time.sleep(seconds)
            return
        with self.context.handle:
            waiting = rcl.WaitSet(0, 0, 0, len(self._clients), 0, 0, self.context.handle)
            with waiting:
                waiting.clear_entities()
                for client in self._clients:
                    waiting.add_client(client.handle)
                waiting.wait(int(seconds * _NANOSECONDS))
            waiting.destroy_when_not_in_use()
        for client in self._clients.copy():
            client.take()

    def destroy_node(self) -> None:
        """Leave the graph."""
        for client in self._clients.copy():
            self.destroy_client(client)
        self.handle.destroy_when_not_in_use()


class BareClient:
    """A client of one service."""

    def __init__(self, node: BareNode, kind: Any, name: str) -> None:  # noqa: ANN401 - as above
        if type(kind)._TYPE_SUPPORT is None:  # noqa: SLF001 - as rclpy does
            type(kind).__import_type_support__()
        self._response = kind.Response
        self._waiting: dict[int, Reply] = {}
        with node.handle:
            profile = rcl.rmw_qos_profile_t.predefined(_SERVICES)
            self.handle = rcl.Client(node.handle, kind, name, profile)

    def service_is_ready(self) -> bool:
        """Tell whether a server is there."""
        with self.handle:
            return bool(self.handle.service_server_is_available())

    def call_async(self, request: Any) -> Reply:  # noqa: ANN401 - as above
        """Send a request."""
        with self.handle:
            number = self.handle.send_request(request)
        reply = self._waiting[number] = Reply()
        return reply

    def take(self) -> None:
        """Hand over the responses that have come."""
        while True:
            with self.handle:
                header, response = self.handle.take_response(self._response)
            if header is None:
                return
            reply = self._waiting.pop(header.request_id.sequence_number, None)
            if reply is not None:
                reply.come(response)


def _counted(count: Callable[[str], int], name: str, *, service: bool) -> int:
    """Return how many there are. Raises `RunError` for what is no name."""
    try:
        return int(count(name))
    except rcl.RCLError:
        refuse(name, service=service)
        raise


def refuse(name: str, *, service: bool) -> None:
    """Raise `RunError` for what is no name."""
    from rclpy.exceptions import NameValidationException  # noqa: PLC0415 - most of rclpy, for a mistake
    from rclpy.validate_full_topic_name import validate_full_topic_name  # noqa: PLC0415 - as above

    try:
        validate_full_topic_name(name, is_service=service)
    except NameValidationException as error:
        raise RunError(one_line(error)) from None


def one_line(error: Exception) -> str:
    """Return what rclpy says of a name, without the caret with which it points."""
    return " ".join(str(error).replace("^", "").split())


def publishers(node: Any, topic: str, *, of_middleware: bool = False) -> list[Endpoint]:  # noqa: ANN401 - of either kind
    """Return the publishers of a topic as a node sees them; one `of_middleware` has a name that is none of ROS."""
    return _endpoints(rcl.rclpy_get_publishers_info_by_topic, node, topic, of_middleware=of_middleware)


def subscriptions(node: Any, topic: str) -> list[Endpoint]:  # noqa: ANN401 - as above
    """Return the subscriptions of a topic as a node sees them."""
    return _endpoints(rcl.rclpy_get_subscriptions_info_by_topic, node, topic, of_middleware=False)


def _endpoints(look: Callable[..., Any], node: Any, topic: str, *, of_middleware: bool) -> list[Endpoint]:  # noqa: ANN401 - as above
    with node.handle:
        return [
            Endpoint(one["node_name"], one["node_namespace"], bytes(one["endpoint_gid"]))
            for one in look(node.handle, topic, of_middleware)
        ]
