"""The package tf2_msgs: the installed one, or one made of its definitions here."""

from __future__ import annotations

import importlib
from typing import Any

from orchestra.ros.interfaces.definitions import provide

# A class of a package without type information.
MessageClass = Any

PACKAGE = "tf2_msgs"
MESSAGE = "TFMessage"


def tf_message_type() -> MessageClass:
    """Return the class of `tf2_msgs/msg/TFMessage`: of the installed package, else one that needs no package.

    Both have the same name, fields, wire format and type hash in the graph.
    """
    try:
        return importlib.import_module(f"{PACKAGE}.msg").TFMessage
    except ModuleNotFoundError as error:
        if error.name not in (PACKAGE, f"{PACKAGE}.msg"):
            raise
    # Only now: it brings geometry_msgs and the C structures, which an installed package makes needless.
    return importlib.import_module("orchestra.ros.interfaces.tf2").TFMessage


def install() -> bool:
    """Make `import tf2_msgs.msg` work in this process, and its services and actions; return whether that was needed."""
    return provide(PACKAGE)
