"""Waits for what wakes a node, without the executor's detour.

rclpy's executor builds a new wait set in Python for each wait and waits twice for each callback, which costs more
than everything that the filter does with 150 messages a second. Here one wait set is filled again each time, from
lists that are made anew only when the node has something else to wait for, and subscriptions are handed over
directly; services, answers to calls and actions, which are rare, still go through the executor. The wait set is the
one that `rclpy.wait_for_message` uses.
"""

from collections.abc import Callable
from dataclasses import dataclass
from types import TracebackType
from typing import Any, Self, TypeAlias

from rclpy.callback_groups import CallbackGroup
from rclpy.event_handler import EventHandler
from rclpy.executors import SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node

from bringup.filter_node.clock_messages import clock_setter, sets_the_clock

WaitSet: TypeAlias = Any
Subscription: TypeAlias = Any
Waitable: TypeAlias = Any
# What a node has at the moment: subscriptions, clients, services and waitables.
Entities: TypeAlias = tuple[tuple[Any, ...], ...]


@dataclass(frozen=True, slots=True, eq=False)
class _Waited:
    """What is waited for, as long as the node has the same `entities`."""

    entities: Entities
    handles: tuple[Any, ...]
    # What takes a message, by the pointer under which the wait set knows the subscription.
    takers: dict[int, Callable[[], None]]
    clocks: tuple[Callable[[], None], ...]
    clients: tuple[Any, ...]
    services: tuple[Any, ...]
    waitables: tuple[Waitable, ...]
    wait_set: WaitSet

    def fill(self) -> WaitSet:
        """Fill the wait set, which a wait leaves with what was ready alone."""
        wait_set = self.wait_set
        wait_set.clear_entities()
        for handle in self.handles:
            wait_set.add_subscription(handle)
        for handle in self.clients:
            wait_set.add_client(handle)
        for handle in self.services:
            wait_set.add_service(handle)
        for waitable in self.waitables:
            waitable.add_to_wait_set(wait_set)
        return wait_set


class Waiting:
    """Waits for one node; subscriptions of the group `left_out` wake nobody."""

    def __init__(self, node: Node, left_out: CallbackGroup) -> None:
        self._node = node
        self._left_out = left_out
        # Its callback does nothing: triggering it ends a wait.
        self._wake_up = node.create_guard_condition(lambda: None)
        self._waited: _Waited | None = None
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
        waited = self._present()
        wait_set = waited.fill()
        wait_set.add_guard_condition(self._wake_up.handle)
        wait_set.wait(timeout)
        for pointer in wait_set.get_ready_entities("subscription"):
            # Waitables have subscriptions of their own, and take from them themselves.
            if (take := waited.takers.get(pointer)) is not None:
                take()
        called = any(waitable.is_ready(wait_set) for waitable in waited.waitables)
        return bool(called or wait_set.get_ready_entities("service") or wait_set.get_ready_entities("client"))

    def look_at_the_clock(self) -> None:
        """Take the time from /clock without waiting for it."""
        for take in self._present().clocks:
            take()

    def serve(self) -> None:
        """Let the executor answer one call, or do whatever else rclpy has put on the node."""
        self._executor.spin_once(timeout_sec=0)

    def _present(self) -> _Waited:
        node = self._node
        entities = tuple(node.subscriptions), tuple(node.clients), tuple(node.services), tuple(node.waitables)
        if self._waited is None or self._waited.entities != entities:
            self._waited = self._listed(entities)
        return self._waited

    def _listed(self, entities: Entities) -> _Waited:
        every, clients, services, waitables = entities
        subscriptions = tuple(each for each in every if each.callback_group is not self._left_out)
        # What rclpy warns of has time until the next turn of the executor.
        waitables = tuple(each for each in waitables if not isinstance(each, EventHandler))
        # Subscriptions, guard conditions, timers, clients, services, events.
        sizes = [len(subscriptions), 1, 0, len(clients), len(services), 0]
        for waitable in waitables:
            sizes = [one + more for one, more in zip(sizes, _sizes(waitable), strict=True)]
        clock = self._node.get_clock()
        clocks = {
            each.handle.pointer: clock_setter(each, clock) for each in subscriptions if sets_the_clock(each)
        }
        return _Waited(
            entities,
            tuple(each.handle for each in subscriptions),
            {each.handle.pointer: _taker(each) for each in subscriptions} | clocks,
            tuple(clocks.values()),
            tuple(each.handle for each in clients),
            tuple(each.handle for each in services),
            waitables,
            rclpy_implementation.WaitSet(*sizes, self._node.context.handle),
        )


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


def _taker(subscription: Subscription) -> Callable[[], None]:
    def take() -> None:
        taken = subscription.handle.take_message(subscription.msg_type, subscription.raw)
        if taken is not None:
            subscription.callback(taken[0])

    return take
