"""Runs the recorder's node until it is told to end."""

from __future__ import annotations

import rclpy

from bringup.beginning import begun
from bringup.ending import leave, spin_until_told
from bringup.evaluation.listening import Recorder


def run() -> int:
    """Run until SIGINT or SIGTERM, both of which the caller must have blocked; 1 if the file cannot be written."""
    return begun("recorder", _run)


def _run() -> int:
    node = rclpy.create_node("recorder")
    try:
        recorder = Recorder(node)
        spin_until_told(node)
        recorder.close()
    except OSError as error:
        node.get_logger().fatal(f"the recording cannot be written: {error}")
        return 1
    finally:
        leave(node)
    return 0
