"""Finds what a component is made by: a class of nodes, or a function that returns a node."""

from __future__ import annotations

import inspect
import os
import sys
from functools import reduce
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

from orchestra.nearest import nearest
from orchestra.resolve.packages.components import declared_components, target_of
from orchestra.ros.container.refusal import RefusalError

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node

    from orchestra.resolve.packages.entry_points import EntryPoint

    Make = Callable[..., Node]

# What a constructor may insist on being given, by the names that rclpy and most code have for it.
_NAME: Final = ("node_name", "name")


class Plugins:
    """The components that can be made here."""

    def __init__(self) -> None:
        self._known: tuple[EntryPoint, ...] = ()
        self._seen: tuple[int, ...] | None = None

    def find(self, package: str, plugin: str) -> Make:
        """Return what makes a component. Raises `RefusalError`, or what an import raises."""
        target = target_of(package, plugin, self._declared())
        if target is None:
            raise RefusalError(self._unknown(package, plugin))
        module, _, name = target.partition(":")
        found = import_module(module)
        try:
            make: Any = reduce(getattr, name.split("."), found)
        except AttributeError:
            meant = nearest(name, (key for key, value in vars(found).items() if isinstance(value, type)))
            hint = f"; did you mean '{module}:{meant}'?" if meant else ""
            raise RefusalError(f"module '{module}' has no '{name}'{hint}") from None
        if not callable(make):
            raise RefusalError(f"'{target}' is no class: it is of type '{type(make).__name__}'")
        return make  # what it makes is seen when it is made

    def _declared(self) -> tuple[EntryPoint, ...]:
        """Return what is declared; it is looked for again where something was installed since."""
        seen = tuple(_changed(folder) for folder in sys.path)
        if seen != self._seen:
            self._known, self._seen = declared_components(), seen
        return self._known

    def _unknown(self, package: str, plugin: str) -> str:
        of_package = f" of package '{package}'" if package else ""
        meant = nearest(plugin, (point.name for point in self._known))
        hint = f"; did you mean '{meant}'?" if meant else ""
        return f"there is no component '{plugin}'{of_package} in Python here{hint}"


def wanted(make: Make, name: str) -> dict[str, str]:
    """Return what a constructor insists on: the name of its node at most. Raises `RefusalError`."""
    try:
        parameters = inspect.signature(make).parameters.values()
    except (TypeError, ValueError):  # written in C
        return {}
    found: dict[str, str] = {}
    for one in parameters:
        if one.default is not one.empty or one.kind in (one.VAR_POSITIONAL, one.VAR_KEYWORD):
            continue
        if one.name not in _NAME or one.kind is one.POSITIONAL_ONLY:
            raise RefusalError(
                f"'{make.__qualname__}' cannot be made without '{one.name}', which no container gives"
            )
        found[one.name] = name or snake_case(make.__name__)
    return found


def snake_case(name: str) -> str:
    """Return the name of a class as nodes are called."""
    letters = (
        f"_{letter.lower()}"
        if letter.isupper() and index and not name[index - 1].isupper()
        else letter.lower()
        for index, letter in enumerate(name)
    )
    return "".join(letters).replace("__", "_")


def _changed(folder: str) -> int:
    try:
        return os.stat(folder or ".").st_mtime_ns  # noqa: PTH116 - no path is wanted
    except OSError:
        return 0
