"""Asks running nodes for parameters over their services: `python asker.py '{"/node": ["name"]}'` prints the values."""

from __future__ import annotations

import json
import sys
import time

import rclpy
from rclpy.parameter import parameter_value_to_python
from rclpy.parameter_client import AsyncParameterClient

PATIENCE = 60.0  # seconds


def main() -> None:
    """Ask and print."""
    rclpy.init()
    node = rclpy.create_node("asker")
    answers = {}
    for target, names in json.loads(sys.argv[1]).items():
        client = AsyncParameterClient(node, target)
        if not client.wait_for_services(PATIENCE):
            sys.exit(f"{target} has no parameter services")
        end = time.monotonic() + PATIENCE
        answer = None
        while answer is None:  # one that comes before the node knows its client is lost
            if time.monotonic() > end:
                sys.exit(f"{target} has not answered")
            future = client.get_parameters(names)
            rclpy.spin_until_future_complete(node, future, timeout_sec=5.0)
            answer = future.result()
        answers[target] = [parameter_value_to_python(value) for value in answer.values]
    print(json.dumps(answers))  # noqa: T201 - the product
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
