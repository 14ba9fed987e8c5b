"""Components of one plugin in one container that have no name: they all take the one that their code has for itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code

if TYPE_CHECKING:
    from orchestra.errors import Problems
    from orchestra.plan.model import Component, Plan
    from orchestra.resolve.model import Resolved


_NAMING = ("__node", "__name", "__ns")  # rcl's rules for a node itself


def _is_renamed(component: Component) -> bool:
    return any(source.endswith(_NAMING) for source, _ in component.remappings)


def check_nameless(resolved: Resolved, plan: Plan, problems: Problems) -> None:
    """Warn of components that come to be called the same, though nobody has written the name."""
    faulty = {component.location for component in resolved.components if component.faulty}
    first: dict[tuple[str | None, ...], Component] = {}
    for component in plan.components:
        if component.name is not None or component.location in faulty or _is_renamed(component):
            continue
        kind = (component.container, component.namespace, component.package, component.plugin)
        other = first.setdefault(kind, component)
        if other is not component:
            message = (
                f"two components of '{component.plugin}' in one container have no name: both take the same"
            )
            notes = (f"the other one is at {other.location}",)
            problems.warning(Code.DUPLICATE_NODE, message, component.location, notes=notes)
