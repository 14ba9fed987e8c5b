"""Components by what a launch file calls them; nothing is imported to find one.

A distribution declares its components as entry points of the group `rclpy_components`, the name that the proposed
package of rclpy has for them (ros2/rclpy#599): `demo::Talker = demo.talker:Talker`. Whatever is not declared is named
by its module: `demo.talker:Talker`.

Those in C++ are in the resource `rclcpp_components` of the ament index: a line `Class;library` each.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.resolve.packages import ament
from orchestra.resolve.packages.entry_points import declared

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path

    from orchestra.resolve.packages.entry_points import EntryPoint

GROUP: Final = "rclpy_components"
_RESOURCE: Final = "rclcpp_components"
_BY_MODULE: Final = re.compile(r"[^\W\d]\w*(\.[^\W\d]\w*)*:[^\W\d]\w*(\.[^\W\d]\w*)*")


def declared_components() -> tuple[EntryPoint, ...]:
    """Return the components that distributions declare."""
    return declared(GROUP)


def registered(environment: Mapping[str, str]) -> dict[str, list[str]]:
    """Return the names of all components that packages register, in C++ and in Python, by the package."""
    found: dict[str, list[str]] = {}
    for prefix in ament.prefixes(environment):
        for package, text in ament.resources(prefix, _RESOURCE):
            found.setdefault(package, []).extend(_names(text))
    for point in declared_components():
        package, colons, _ = point.name.partition("::")
        found.setdefault(package if colons else point.owners[0], []).append(point.name)
    return {package: list(dict.fromkeys(found[package])) for package in sorted(found)}


def registered_by(package: str, prefix: Path) -> list[str]:
    """Return the names of the components in C++ that a package registers in a prefix."""
    text = ament.resource(prefix, _RESOURCE, package)
    return [] if text is None else _names(text)


def _names(text: str) -> list[str]:
    """Return the names in a resource: what stands before the first semicolon of a line."""
    names = (line.partition(";")[0].strip() for line in text.splitlines())
    return [name for name in names if name]


def is_named_by_module(plugin: str) -> bool:
    """Tell whether a component is named as `module:Class`."""
    return _BY_MODULE.fullmatch(plugin) is not None


def target_of(package: str, plugin: str, known: Iterable[EntryPoint]) -> str | None:
    """Return `module:Class` of a component, None where it is none in Python that is known."""
    names = (plugin, f"{package}::{plugin}")
    found = [point for point in known if point.name in names]
    own = [point for point in found if package in point.owners]
    if found:
        return (own or found)[0].target
    return plugin if is_named_by_module(plugin) else None
