"""Topics, services and actions of nodes that cannot talk with each other, where executables declare them."""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING, Final

from orchestra.declared.interfaces.finding import may_be_declared
from orchestra.plan.checks.declared import nodes_of
from orchestra.plan.ids import domains_of

if TYPE_CHECKING:
    from orchestra.errors import Problems
    from orchestra.plan.model import Plan
    from orchestra.resolve.model import Resolved

_EXECUTABLE: Final = attrgetter("share", "executable")
_PLUGIN: Final = attrgetter("share", "plugin")


def check_interfaces(resolved: Resolved, plan: Plan, problems: Problems) -> None:
    """Report what keeps nodes from talking with each other; nothing is known where no package declares interfaces."""
    programs = {*map(_EXECUTABLE, resolved.processes), *map(_PLUGIN, resolved.components)}
    called: dict[str, set[str]] = {}
    for share, name in programs:
        if share is not None:  # as that of what is no node is
            called.setdefault(share, set()).add(name)
    if not any(may_be_declared(share, names) for share, names in called.items()):
        return
    # Here, because few packages declare interfaces, and for what it imports.
    from orchestra.plan.connections import check_connections  # noqa: PLC0415

    nodes = nodes_of(resolved, plan)
    domains = domains_of(resolved)
    if domains is None:
        check_connections(nodes, problems)
        return
    for domain in dict.fromkeys(domains.values()):  # nodes of two never meet
        check_connections([item for item in nodes if domains[id(item[0])] == domain], problems)
