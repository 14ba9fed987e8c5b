"""Message classes by name, and the ones of packages that the package index lacks.

Nothing here needs rclpy to be imported first, and rclpy needs nothing from here.
"""

from orchestra.ros.interfaces.names import UnknownMessageTypeError, install, message_type, tf_message_type

__all__ = ["UnknownMessageTypeError", "install", "message_type", "tf_message_type"]
