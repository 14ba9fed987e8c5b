"""Nodes work until they are told to end: by SIGINT or SIGTERM, which a thread waits for."""

from __future__ import annotations

import signal
from threading import Event, Thread
from typing import TYPE_CHECKING

from rclpy.executors import SingleThreadedExecutor

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node

ENDING = (signal.SIGINT, signal.SIGTERM)


def wait_for_the_end(told_to_end: Event, wake_up: Callable[[], None]) -> None:
    """Wait for one of the two, which the caller must have blocked; then set the event and wake up who goes by it."""
    signal.sigwait(ENDING)
    told_to_end.set()
    wake_up()


def leave(node: Node) -> None:
    """Take a node out of the graph, after which its process ends; SIGTERM ends the process at once from here on.

    Fast DDS may never come back from giving its participant back while other nodes come or go: it waits for one of its
    callbacks in a loop that leaves the callback no lock (eProsima/Fast-DDS#6513). Whoever waits for the end of the
    process sends SIGTERM next, and nothing of the node is left to do then.
    """
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, (signal.SIGTERM,))
    node.destroy_node()


def spin_until_told(node: Node) -> None:
    """Let a node work until SIGINT or SIGTERM.

    Both must be blocked by the caller: they are waited for in a thread of their own, so that nothing is ever
    interrupted half-way and the node leaves the graph at once. What its callbacks raise is raised.
    """
    told_to_end = Event()
    # Its callback does nothing: it makes the executor come back.
    wake_up = node.create_guard_condition(lambda: None)

    ending = Thread(target=wait_for_the_end, args=(told_to_end, wake_up.trigger), daemon=True)
    ending.start()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        while not told_to_end.is_set():
            executor.spin_once()
        # The trigger must not meet a destroyed node; a fault of a callback ends the node without waiting.
        ending.join()
    finally:
        executor.remove_node(node)
        executor.shutdown()
