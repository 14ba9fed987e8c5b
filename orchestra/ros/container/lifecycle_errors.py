"""Tells what the transitions of a lifecycle node raise: rclpy 7.1 takes it for an error and loses what it was."""

from __future__ import annotations

import traceback
from functools import wraps
from typing import TYPE_CHECKING, Any

from rclpy.lifecycle import LifecycleNodeMixin

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node


def tell_errors(node: Node) -> None:
    """Have the callbacks of a node's transitions, where it has some, log what they raise."""
    if isinstance(node, LifecycleNodeMixin):
        callbacks = node._callbacks  # noqa: SLF001 - rclpy has no other way
        callbacks.update({state: _telling(node, callback) for state, callback in callbacks.items()})


def _telling(node: Any, callback: Callable[[Any], Any]) -> Callable[[Any], Any]:  # noqa: ANN401 - of an untyped package
    @wraps(callback)
    def called(state: Any) -> Any:  # noqa: ANN401 - as above
        try:
            return callback(state)
        except Exception:
            node.get_logger().error(f"{callback.__name__} has failed:\n{traceback.format_exc()}")
            raise

    return called
