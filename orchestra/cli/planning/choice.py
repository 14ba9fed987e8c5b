"""The processes and components of a plan that `--node` names, by the same rules as those of a run that are stopped."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.control.selection import UnmatchedError, select
from orchestra.errors import UsageError
from orchestra.plan.selected import selected

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.plan.model import Plan

_MOST_TOLD = 8


def chosen(plan: Plan, patterns: Sequence[str]) -> Plan:
    """Return the part of a plan that fits the patterns, all of it where there are none. Raises `UsageError`."""
    if not patterns:
        return plan
    return selected(plan, ids_chosen(ids_of(plan), patterns))


def ids_chosen(ids: Sequence[str], patterns: Sequence[str]) -> Sequence[str]:
    """Return the ids that fit the patterns. Raises `UsageError`, which names the nearest, for one in vain."""
    try:
        return select(patterns, ids)
    except UnmatchedError as error:
        raise UsageError(f"{error}{'' if error.meant else _known(ids)}") from error


def ids_of(plan: Plan) -> list[str]:
    """Return the ids of all processes and components."""
    return [process.id for process in plan.processes] + [component.id for component in plan.components]


def _known(ids: Sequence[str]) -> str:
    if not ids:
        return "; the plan has none"
    more = f" and {len(ids) - _MOST_TOLD} more" if len(ids) > _MOST_TOLD else ""
    return f"; there are {', '.join(ids[:_MOST_TOLD])}{more}"
