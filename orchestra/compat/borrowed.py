"""Names that modules of upstream happen to have because they import them, and that launch files import from there."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Callable

ROOM: Final = __name__.rpartition(".")[0]
# Where a name is looked for, in this order: `Parameter` is also a substitution, `Shutdown` also an event.
PACKAGES: Final = (
    "launch_ros.descriptions",
    "launch_ros.actions",
    "launch_ros.parameter_descriptions",
    "launch_ros.parameters_type",
    "launch_ros.remap_rule_type",
    "launch_ros.substitutions",
    "launch_ros.utilities",
    "launch",
    "launch.actions",
    "launch.substitutions",
    "launch.conditions",
    "launch.event_handlers",
    "launch.events",
    "launch.launch_description_sources",
    "launch.utilities",
    "launch.frontend",
)
# Modules of one class each, easily taken for the package of many: `launch.substitution` for `launch.substitutions`.
_FEW: Final = frozenset(
    f"launch.{name}"
    for name in (
        *("action", "condition", "event", "event_handler", "launch_description_source"),
        "substitution",
    )
)
# Modules of what nodes are given, which have little else.
_TYPES: Final = ("launch_ros.parameter", "launch_ros.remap_rule_type")


def borrowing(module: str) -> Callable[[str], Any]:
    """Return the `__getattr__` of a module that has public names of other modules too.

    Packages tell what they export, so that only single modules borrow: `launch_ros.actions.node.ParameterFile`.
    """
    packages = [name for name in PACKAGES if module.startswith(f"{ROOM}.launch_ros") or "_ros" not in name]
    if module.removeprefix(f"{ROOM}.") in _FEW:
        packages = ["launch"]
    elif module.startswith(f"{ROOM}.ament_index_python"):
        packages = ["ament_index_python"]
    elif module.removeprefix(f"{ROOM}.").startswith(_TYPES):
        packages = ["launch", "launch.utilities"]

    def attribute(name: str) -> Any:
        for package in () if name.startswith("_") else packages:
            exporting = import_module(f"{ROOM}.{package}")
            if name in getattr(exporting, "__all__", vars(exporting)):
                return getattr(exporting, name)
        raise AttributeError(f"module {module!r} has no attribute {name!r}")

    return attribute
