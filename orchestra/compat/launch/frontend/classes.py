"""The classes that names of the launch language stand for."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def class_at(place: str, kind: str) -> Any:
    """Return the class at a place as `launch_ros:Node`; `kind` is `actions` or `substitutions`."""
    package, _, name = place.partition(":")
    return getattr(import_module(f"orchestra.compat.{package}.{kind}"), name)
