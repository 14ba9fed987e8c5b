"""The package composition_interfaces: the installed one, or its service LoadNode made here."""

from __future__ import annotations

import importlib
from typing import Any

# A class of a package without type information.
ServiceClass = Any

PACKAGE = "composition_interfaces"


def load_node_type() -> ServiceClass:
    """Return the class of `composition_interfaces/srv/LoadNode`: of the installed package, else one without it.

    Both have the same name, fields, wire format and type hash in the graph. Raises `ImportError`, which names the
    package, where it is not installed and the ROS libraries are not those that the other one is made for.
    """
    try:
        return importlib.import_module(f"{PACKAGE}.srv").LoadNode
    except ModuleNotFoundError as error:
        if error.name not in (PACKAGE, f"{PACKAGE}.srv"):
            raise
    # Only now: it makes C structures, which an installed package makes needless.
    found = importlib.import_module("orchestra.ros.interfaces.load_node").LoadNode
    type(found).__import_type_support__()
    return found
