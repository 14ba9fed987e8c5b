"""Message classes by name, and those of packages that are not on the package index."""

from __future__ import annotations

from typing import Any


def tf_message_type() -> Any:
    """The class of `tf2_msgs/msg/TFMessage`."""
    try:
        from tf2_msgs.msg import TFMessage
    except ModuleNotFoundError:
        from orchestra.ros.interfaces.tf2 import TFMessage
    return TFMessage
