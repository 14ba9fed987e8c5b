"""Questions about the class of an object."""

from __future__ import annotations

import inspect
from typing import Any


def isclassinstance(obj: object) -> bool:
    """Return whether an object is one of a class, which every object is."""
    return hasattr(obj, "__class__")


def is_a(obj: object, entity_type: type[Any]) -> bool:
    """Return whether an object is one of a class. Raises `RuntimeError` where that is no class."""
    if not inspect.isclass(entity_type):
        raise RuntimeError(f"{entity_type!r} is not a class")
    return isinstance(obj, entity_type)


def is_a_subclass(obj: object, entity_type: type[Any]) -> bool:
    """Return whether an object is one of a class, or itself a subclass of it."""
    return is_a(obj, entity_type) or (inspect.isclass(obj) and issubclass(obj, entity_type))
