"""Asks running nodes for parameters over their services: `python asker.py '{"/node": ["name"]}'` prints the values."""

from __future__ import annotations

import json
import sys

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
        future = client.get_parameters(names)
        rclpy.spin_until_future_complete(node, future, timeout_sec=PATIENCE)
        answers[target] = [parameter_value_to_python(value) for value in future.result().values]
    print(json.dumps(answers))  # noqa: T201 - the product
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
