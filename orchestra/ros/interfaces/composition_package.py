"""The service LoadNode: of the installed package composition_interfaces, or of its definition here."""

from __future__ import annotations

import importlib
from typing import Any

from orchestra.ros.interfaces.definitions import provide

# A class of a package without type information.
ServiceClass = Any

PACKAGE = "composition_interfaces"


def load_node_type() -> ServiceClass:
    """Return the class of `composition_interfaces/srv/LoadNode`: of the installed package, else one without it.

    Both have the same name, fields, wire format and type hash in the graph. Raises `ImportError`, which names the
    package, where it is not installed and the ROS libraries are not those that the other one is made for.
    """
    provide(PACKAGE)
    found = importlib.import_module(f"{PACKAGE}.srv").LoadNode
    type(found).__import_type_support__()
    return found
