"""A node with a topic, a service and an action of a package of definitions, until standard input ends."""

from __future__ import annotations

import sys
import threading
from typing import Any

import rclpy
from rclpy.action import ActionServer
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile

from orchestra.ros.interfaces.definitions import install

ENOUGH = 8  # the number with which the client says that it has feedback


def main(folder: str) -> None:
    if folder:
        install("own_interfaces", folder)
    from own_interfaces.action import Go  # type: ignore[import-not-found]  # noqa: PLC0415 - there is none before
    from own_interfaces.msg import Part, Whole  # type: ignore[import-not-found]  # noqa: PLC0415 - as above
    from own_interfaces.srv import Ask  # type: ignore[import-not-found]  # noqa: PLC0415 - as above

    heard = threading.Event()
    rclpy.init()
    node = rclpy.create_node("server")
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    publisher = node.create_publisher(Whole, "whole", latched)

    def answer(request: Any, response: Any) -> Any:
        response.ok, response.back = request.number == 7, request.whole
        if request.number == ENOUGH:
            heard.set()
        return response

    def go(goal: Any) -> Any:
        # What is sent before the client's reader is matched is lost, so it goes on until the client has some.
        while not heard.wait(0.05):
            goal.publish_feedback(Go.Feedback(remaining=1.5))
        goal.succeed()
        return Go.Result(notes=[goal.request.target.name, "é"], distance=2.5)

    node.create_service(Ask, "ask", answer)
    server = ActionServer(node, Go, "go", go, callback_group=ReentrantCallbackGroup())
    publisher.publish(Whole(parts=[Part(wide="a😀")] * 2, wides=["x", ""], few=[0.5], bytes=[b"\xff"]))
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(node)
    print("ready", flush=True)  # noqa: T201 - the test reads it
    ended = threading.Event()

    def wait() -> None:
        sys.stdin.read()
        ended.set()

    threading.Thread(target=wait, daemon=True).start()
    while not ended.is_set():
        executor.spin_once(timeout_sec=0.05)
    executor.shutdown()
    server.destroy()
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main(sys.argv[1])
