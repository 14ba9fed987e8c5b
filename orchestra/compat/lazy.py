"""Packages whose names are imported when somebody asks for them: a launch file pays for what it uses."""

from __future__ import annotations

import sys
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from orchestra.compat import pristine

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping


def exported(package: str, names: Mapping[str, str]) -> Callable[[str], Any]:
    """Return the `__getattr__` of a package.

    `names` gives for each name the submodule that has it, with dots for deeper ones; an empty text where the name is
    that of a submodule itself, and a name that begins with `orchestra.` is the module's full name. Submodules need no
    place in it: whoever imports one of upstream's packages has nearly all of its modules.
    """

    def attribute(name: str) -> Any:
        place = names.get(name)
        if place is None and not name.startswith("_") and find_spec(f"{package}.{name}") is not None:
            place = ""
        if place is None:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        if not place:
            return import_module(f"{package}.{name}")
        full = place if place.startswith("orchestra.") else f"{package}.{place}"
        value = getattr(import_module(full), name)
        # Also over a submodule of the same name, as an import would.
        setattr(sys.modules[package], name, value)
        pristine.keep(value, sys.modules[package], name)
        return value

    return attribute
