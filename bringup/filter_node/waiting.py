"""Waits for what wakes a node, without the executor's detour.

rclpy's executor builds a new wait set in Python for each wait and waits twice for each callback, which costs more
than everything that the filter does with 150 messages a second. Here one wait set is filled again each time and
subscriptions are handed over directly; services, answers to calls and actions, which are rare, still go through the
executor. The wait set is the one that `rclpy.wait_for_message` uses.
"""

from collections.abc import Callable
from types import TracebackType
from typing import Any, Self, TypeAlias

from rclpy.callback_groups import CallbackGroup
from rclpy.executors import SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node

WaitSet: TypeAlias = Any
Subscription: TypeAlias = Any
Waitable: TypeAlias = Any


class Waiting:
    """Waits for one node; subscriptions of the group `left_out` wake nobody."""

    def __init__(self, node: Node, left_out: CallbackGroup) -> None:
        self._node = node
        self._left_out = left_out
        # Its callback does nothing: triggering it ends a wait.
        self._wake_up = node.create_guard_condition(lambda: None)
        self._wait_set: WaitSet = None
        self._sizes: tuple[int, ...] = ()
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(node)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._executor.remove_node(self._node)
        self._executor.shutdown()

    @property
    def wake_up(self) -> Callable[[], None]:
        """End a wait, from any thread."""
        trigger: Callable[[], None] = self._wake_up.trigger
        return trigger

    def wait(self, timeout: int) -> bool:
        """Wait up to `timeout` ns (-1: for ever) and hand over what has come; tells whether there is more to serve."""
        subscriptions = [
            subscription
            for subscription in self._node.subscriptions
            if subscription.callback_group is not self._left_out
        ]
        wait_set = self._filled(subscriptions)
        wait_set.wait(timeout)
        ready = wait_set.get_ready_entities("subscription")
        for subscription in subscriptions:
            if subscription.handle.pointer in ready:
                _hand_over(subscription)
        called = any(waitable.is_ready(wait_set) for waitable in self._node.waitables)
        return bool(called or wait_set.get_ready_entities("service") or wait_set.get_ready_entities("client"))

    def serve(self) -> None:
        """Let the executor answer one call, or do whatever else rclpy has put on the node."""
        self._executor.spin_once(timeout_sec=0)

    def _filled(self, subscriptions: list[Subscription]) -> WaitSet:
        services, clients, waitables = (
            list(self._node.services),
            list(self._node.clients),
            list(self._node.waitables),
        )
        # Subscriptions, guard conditions, timers, clients, services, events.
        sizes = [len(subscriptions), 1, 0, len(clients), len(services), 0]
        for waitable in waitables:
            sizes = [one + more for one, more in zip(sizes, _sizes(waitable), strict=True)]
        if self._wait_set is None or tuple(sizes) != self._sizes:
            self._sizes = tuple(sizes)
            self._wait_set = rclpy_implementation.WaitSet(*sizes, self._node.context.handle)
        self._wait_set.clear_entities()
        for subscription in subscriptions:
            self._wait_set.add_subscription(subscription.handle)
        for service in services:
            self._wait_set.add_service(service.handle)
        for client in clients:
            self._wait_set.add_client(client.handle)
        for waitable in waitables:
            waitable.add_to_wait_set(self._wait_set)
        self._wait_set.add_guard_condition(self._wake_up.handle)
        return self._wait_set


def _sizes(waitable: Waitable) -> tuple[int, ...]:
    needed = waitable.get_num_entities()
    return (
        needed.num_subscriptions,
        needed.num_guard_conditions,
        needed.num_timers,
        needed.num_clients,
        needed.num_services,
        needed.num_events,
    )


def _hand_over(subscription: Subscription) -> None:
    taken = subscription.handle.take_message(subscription.msg_type, False)
    if taken is not None:
        subscription.callback(taken[0])
