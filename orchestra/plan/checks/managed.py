"""Names that a lifecycle manager of Nav2 is given: it waits for each of them, and brings up none before all are there.

Another launch file may start what is not in this one, so told is only a name that is a slip for that of a node here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.nearest import may_look
from orchestra.resolve.typos import is_typo

if TYPE_CHECKING:
    from orchestra.errors import Problems
    from orchestra.plan.model import Component, Plan, Process
    from orchestra.plan.written import Written

_LIST: Final = "node_names"
_STEPS: Final = 4  # of a look at a name, see `may_look`


def check_managed(manager: Process | Component, written: Written, plan: Plan, problems: Problems) -> None:
    """Report names in the list of a lifecycle manager, which is `written` so, that are slips for those of nodes."""
    listed = manager.parameters.get(_LIST)
    if not isinstance(listed, tuple) or written.value is None:
        return
    nodes: tuple[Process | Component, ...] = (*plan.processes, *plan.components)
    names = {item.name for item in nodes if item.name is not None}
    others = names.difference(map(str, listed))
    for index, name in enumerate(listed):
        called = str(name).rpartition("/")[2]
        if called in names or not may_look(_STEPS * len(others)):
            continue
        near = [other for other in others if is_typo(called, other)]
        if len(near) != 1:
            continue
        at = written.items[index] if index < len(written.items) else written.value
        told = f"no node is called '{name}', for which the lifecycle manager waits before it brings up any"
        problems.warning(Code.UNKNOWN_DEPENDENCY, told, at, suggestion=near[0])
