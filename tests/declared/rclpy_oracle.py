"""Says what rclpy makes of a value that a node is given for a parameter it declares.

Reads one JSON line `{"type": WORD, "value": VALUE, "range": [FROM, TO, STEP] or null}` after the other; answers each
with `true` where the declaration succeeds.
"""

import json
import sys

import rclpy
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.exceptions import InvalidParameterTypeException, InvalidParameterValueException
from rclpy.node import Node
from rclpy.parameter import Parameter


def descriptor(kind: str, limits: list[float] | None) -> ParameterDescriptor:
    found = ParameterDescriptor()
    if limits is not None:
        low, high, step = limits
        if kind == "integer":
            found.integer_range = [IntegerRange(from_value=int(low), to_value=int(high), step=int(step))]
        else:
            found.floating_point_range = [
                FloatingPointRange(from_value=float(low), to_value=float(high), step=float(step))
            ]
    return found


def is_taken(kind: str, value: object, limits: list[float] | None) -> bool:
    node = Node(
        "oracle",
        parameter_overrides=[Parameter("x", value=value)],
        start_parameter_services=False,
        enable_rosout=False,
    )
    try:
        node.declare_parameter("x", Parameter.Type[kind.upper()], descriptor(kind, limits))
    except (InvalidParameterTypeException, InvalidParameterValueException):
        return False
    finally:
        node.destroy_node()
    return True


def main() -> None:
    rclpy.init()
    for line in sys.stdin:
        asked = json.loads(line)
        sys.stdout.write(json.dumps(is_taken(asked["type"], asked["value"], asked["range"])) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
