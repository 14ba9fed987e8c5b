"""The package tf2_msgs: the installed one, or its one message made here."""

from __future__ import annotations

import importlib
import sys
from types import ModuleType
from typing import Any

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
    """Make `import tf2_msgs.msg` work in this process; returns whether that was needed.

    Only TFMessage is in the module, none of the other types of tf2_msgs.
    """
    found = tf_message_type()
    if PACKAGE in sys.modules:
        return False
    package, messages = ModuleType(PACKAGE), ModuleType(f"{PACKAGE}.msg")
    package.__path__ = []
    vars(package)["msg"] = messages
    vars(messages)[MESSAGE] = found
    sys.modules |= {package.__name__: package, messages.__name__: messages, found.__module__: messages}
    return True
