"""A part of a plan: what concerns some of its processes and components."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.fields import replace

if TYPE_CHECKING:
    from collections.abc import Collection

    from orchestra.plan.model import Plan
    from orchestra.plan.reactions import Trigger, TriggeredAction


def selected(plan: Plan, ids: Collection[str]) -> Plan:
    """Return the plan with these processes and components alone.

    The components of a container that is chosen belong to it. Triggers stay that are set off by one of them or do
    something to one. What conditions left out is no part of it, nor are the problems.
    """
    processes = tuple(process for process in plan.processes if process.id in ids)
    chosen = {process.id for process in processes}
    components = tuple(item for item in plan.components if item.id in ids or item.process in chosen)
    chosen.update(component.id for component in components)
    triggers = tuple(trigger for trigger in plan.triggers if _concerns(trigger, chosen))
    return replace(
        plan, processes=processes, components=components, triggers=triggers, skipped=(), problems=()
    )


def _concerns(trigger: Trigger, ids: Collection[str]) -> bool:
    return trigger.on.target in ids or any(not ids_of(action).isdisjoint(ids) for action in trigger.do)


def ids_of(action: TriggeredAction) -> set[str]:
    """Return the processes and components that an action is carried out on."""
    one = (getattr(action, "process", None), getattr(action, "component", None))
    return {name for name in (*one, *getattr(action, "processes", ())) if name is not None}
