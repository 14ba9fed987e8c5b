"""Serves the supervisor: orders come in, answers go out, and in between the executor waits for what nodes say.

It sleeps until an order wants to look at something, a node has said something, or an order comes. Orders are read by a
thread of their own, which hands them to the executor, so that none waits for the next look.
"""

from __future__ import annotations

import json
import os
import threading
from queue import SimpleQueue
from typing import Any

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions

from orchestra.ros.observer.desk import Desk
from orchestra.ros.observer.participant import hidden_node


def observe(requests: int, answers: int) -> None:
    """Serve the supervisor on two descriptors until the first one ends."""
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    try:
        node = hidden_node()
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        _serve(requests, Desk(node, answers), executor)
        executor.shutdown()
        node.destroy_node()
    finally:
        rclpy.try_shutdown()


def _serve(requests: int, desk: Desk, executor: SingleThreadedExecutor) -> None:
    desk.greet()
    threading.Thread(target=_read, args=(requests, desk, executor), daemon=True).start()
    while not desk.closed:
        executor.spin_once(timeout_sec=desk.pause)
        desk.look()


def _read(requests: int, desk: Desk, executor: SingleThreadedExecutor) -> None:
    """Wake the executor's thread for each order; tasks would be carried out in another order than they were made."""
    waiting: SimpleQueue[dict[str, Any] | None] = SimpleQueue()
    with os.fdopen(requests, "rb", closefd=False) as stream:
        for line in stream:
            waiting.put(json.loads(line))
            executor.create_task(desk.take, waiting)
    waiting.put(None)
    executor.create_task(desk.take, waiting)
