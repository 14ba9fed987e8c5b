"""Topics and services that wake nobody: what has come is taken when it is needed, as often as that is.

Ten robots publish a thousand messages a second, of which a summary needs the last ones. And requests that are taken
together can be decided together.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.event_handler import SubscriptionEventCallbacks

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rclpy.node import Node
    from rclpy.qos import QoSProfile

Message: TypeAlias = Any
Subscription: TypeAlias = Any
Service: TypeAlias = Any

# The two events that rclpy adds to each subscription only repeat the peer's warning.
_UNWATCHED = SubscriptionEventCallbacks(use_default_callbacks=False)


class _NeverExecuted(MutuallyExclusiveCallbackGroup):  # type: ignore[misc] # rclpy is untyped
    """Keeps an executor from waiting for what is in this group."""

    def can_execute(self, entity: object) -> bool:  # noqa: ARG002 - the signature is rclpy's
        """Never."""
        return False


def subscribe(node: Node, kind: type, topic: str, qos: QoSProfile) -> Subscription:
    """Subscribe to a topic whose messages are left with the middleware, as many as `qos` holds."""
    return node.create_subscription(
        kind, topic, lambda _: None, qos, callback_group=_NeverExecuted(), event_callbacks=_UNWATCHED
    )


def messages(subscription: Subscription) -> Iterator[Message]:
    """Take what has come, the oldest first."""
    kind, handle = subscription.msg_type, subscription.handle
    with handle:
        while (taken := handle.take_message(kind, False)) is not None:
            yield taken[0]


def serve(node: Node, kind: type, name: str) -> Service:
    """Offer a service whose requests are left with the middleware."""
    return node.create_service(kind, name, lambda _, response: response, callback_group=_NeverExecuted())


def requests(service: Service) -> Iterator[tuple[Message, Any]]:
    """Take the requests that have come, each with what its answer is sent to."""
    handle, kind = service.handle, service.srv_type.Request
    with handle:
        while True:
            request, header = handle.service_take_request(kind)
            if header is None:
                return
            yield request, header
