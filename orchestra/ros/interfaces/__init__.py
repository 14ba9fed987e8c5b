"""Message classes by name, and the types of packages that the package index lacks: TFMessage and LoadNode.

Nothing here needs rclpy to be imported first, and rclpy needs nothing from here. A node that only wants TFMessage
does not pay for finding types by their names: what a name stands for is loaded when it is asked for.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from orchestra.ros.interfaces.composition_package import load_node_type
    from orchestra.ros.interfaces.names import UnknownMessageTypeError, message_type
    from orchestra.ros.interfaces.tf_package import install, tf_message_type

__all__ = ["UnknownMessageTypeError", "install", "load_node_type", "message_type", "tf_message_type"]

_MODULES = {
    "UnknownMessageTypeError": "names",
    "install": "tf_package",
    "load_node_type": "composition_package",
    "message_type": "names",
    "tf_message_type": "tf_package",
}


if not TYPE_CHECKING:  # where types are checked, an unknown name is an error

    def __getattr__(name: str) -> object:
        """Import a public name when it is first asked for."""
        if name not in _MODULES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        return getattr(importlib.import_module(f"{__name__}.{_MODULES[name]}"), name)
