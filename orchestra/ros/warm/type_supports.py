"""The libraries that a middleware loads where a type is used first, by names that follow from the type's package."""

from __future__ import annotations

import ctypes
from contextlib import suppress
from functools import cache

# By the implementation of rmw: what it asks a type for. Another one loads what it needs in the node.
_WANTED = {
    "rmw_cyclonedds_cpp": ("introspection_c",),
    "rmw_fastrtps_cpp": ("fastrtps_c", "introspection_c"),
    "rmw_fastrtps_dynamic_cpp": ("introspection_c",),
}


@cache
def load_type_supports(package: str) -> None:
    """Load those of a package's types; rclpy has been imported. What is not there is left to the node."""
    for kind in _wanted():
        with suppress(OSError):
            ctypes.CDLL(f"lib{package}__rosidl_typesupport_{kind}.so")


@cache
def _wanted() -> tuple[str, ...]:
    # Only here: this is imported before it is known whether there is an rclpy.
    from rclpy.utilities import get_rmw_implementation_identifier  # noqa: PLC0415

    return _WANTED.get(get_rmw_implementation_identifier(), ())
