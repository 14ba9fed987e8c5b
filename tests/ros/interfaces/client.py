"""Hears the topic, calls the service and sends a goal of `server`; prints what came, and what the graph tells."""

from __future__ import annotations

import json
import sys
from typing import Any

import rclpy
from rclpy.action import ActionClient
from rclpy.qos import DurabilityPolicy, QoSProfile

from orchestra.ros.interfaces.definitions import install


def main(folder: str) -> None:
    if folder:
        install("own_interfaces", folder)
    import own_interfaces  # type: ignore[import-not-found]  # noqa: PLC0415 - there is none before
    from own_interfaces.action import Go  # type: ignore[import-not-found]  # noqa: PLC0415 - as above
    from own_interfaces.msg import Part, Whole  # type: ignore[import-not-found]  # noqa: PLC0415 - as above
    from own_interfaces.srv import Ask  # type: ignore[import-not-found]  # noqa: PLC0415 - as above

    rclpy.init()
    node = rclpy.create_node("client")

    def result_of(future: Any) -> Any:
        rclpy.spin_until_future_complete(node, future, timeout_sec=60)
        return future.result()

    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    heard: list[Any] = []
    node.create_subscription(Whole, "whole", heard.append, latched)
    while not heard:
        rclpy.spin_once(node, timeout_sec=0.5)
    # In this order: a server that answers the later client knows the readers of the first as well.
    action = ActionClient(node, Go, "go")
    service = node.create_client(Ask, "ask")
    assert action.wait_for_server(60)
    assert service.wait_for_service(60)
    sent = Whole(parts=[Part(name="left")], many=[1, 2], pair=[-1, 1], three=[True, False, True])
    answer = None
    for _ in range(12):  # what is answered before the server knows its client is lost
        future = service.call_async(Ask.Request(whole=sent, number=7))
        rclpy.spin_until_future_complete(node, future, timeout_sec=5)
        if (answer := future.result()) is not None:
            break
    assert answer is not None
    feedback: list[Any] = []
    goal = result_of(
        action.send_goal_async(
            Go.Goal(target=Part(name="there")), lambda each: feedback.append(each.feedback)
        )
    )
    while len(feedback) < 2:
        rclpy.spin_once(node, timeout_sec=0.5)
    result_of(service.call_async(Ask.Request(number=8)))
    result = result_of(goal.get_result_async())
    (publisher,) = node.get_publishers_info_by_topic("/whole")
    found = {
        "package": own_interfaces.__file__,
        "heard": repr(heard[0]),
        "hash": str(publisher.topic_type_hash),
        "answer": [answer.ok, answer.back == sent],
        "result": [result.status, repr(result.result)],
        "feedback": sorted({each.remaining for each in feedback}),
    }
    print(json.dumps(found))  # noqa: T201 - the test reads it
    action.destroy()
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main(sys.argv[1])
