"""Nodes of the observer, and a look at the graph with fresh eyes.

A participant that was killed stays in the graphs of those who knew it for its lease, 20 s with Fast DDS (measured): who
asks for a node that has just been started again sees the dead one. It says nothing any more, so whoever joins
after its death does not learn of it.
"""

from __future__ import annotations

import itertools
import os
from typing import TYPE_CHECKING

import rclpy

if TYPE_CHECKING:
    from rclpy.context import Context
    from rclpy.node import Node

_NUMBERS = itertools.count()


def hidden_node(context: Context | None = None) -> Node:
    """Return a node that asks for nothing; the underscore hides it, so that tools leave it out."""
    return rclpy.create_node(
        f"_orchestra_observer_{os.getpid()}_{next(_NUMBERS)}",
        context=context,
        start_parameter_services=False,
        enable_rosout=False,
        use_global_arguments=False,
    )


class FreshEyes:
    """A node in a participant of its own, which knows nobody yet."""

    def __init__(self) -> None:
        self._context = rclpy.Context()
        rclpy.init(args=[], context=self._context)
        self.node = hidden_node(self._context)

    def close(self) -> None:
        """Leave the graph again."""
        self.node.destroy_node()
        rclpy.shutdown(context=self._context)
