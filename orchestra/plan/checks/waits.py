"""Waits for what never comes: the end of a process that is always started again, a node that nobody starts."""

from __future__ import annotations

from itertools import chain
from operator import attrgetter
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.plan.absent import is_mistake
from orchestra.plan.ids import node_name
from orchestra.resolve.typos import is_typo

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from orchestra.errors import Problems
    from orchestra.location import Location
    from orchestra.plan.conditions import Ready
    from orchestra.plan.model import Plan, Process
    from orchestra.resolve.awaited import ResolvedReady
    from orchestra.resolve.context import Value
    from orchestra.resolve.model import Resolved, ResolvedComponent, ResolvedProcess
    from orchestra.resolve.typos_among import Names

_DEPENDS_ON: Final = attrgetter("depends_on")
_READY: Final = attrgetter("ready")


def check_waits(resolved: Resolved, plan: Plan, problems: Problems) -> None:
    """Report dependencies that cannot come about, and facts about nodes whose names are slips."""
    ends = [
        edge
        for edge in chain.from_iterable(map(_DEPENDS_ON, plan.processes))
        if edge.required and edge.condition in ("completed", "exited")
    ]
    if ends:
        by_id = {process.id: process for process in plan.processes}
        for edge in ends:
            _check_end(by_id.get(edge.process), edge.condition, edge.location, problems)
    if not any(map(_READY, plan.processes)):
        return
    nodes: list[ResolvedProcess | ResolvedComponent] = [*resolved.processes, *resolved.components]
    started = _Started({name for node in nodes if (name := node_name(node)) is not None})
    for process, written in zip(plan.processes, resolved.processes, strict=True):
        if process.ready is not None and written.ready is not None:
            for name, place in _nodes(process.ready, written.ready):
                _check_node(name, place, started, resolved, problems)


def _check_end(awaited: Process | None, condition: str, location: Location, problems: Problems) -> None:
    """Report the wait for the end of a process that starts again whenever it ends."""
    restart = None if awaited is None else awaited.restart
    if awaited is None or restart is None or restart.policy != "always" or restart.budget is not None:
        return
    end = "completed" if condition == "completed" else "over"
    problems.error(
        Code.NEVER_READY,
        f"'{awaited.id}' is started again whenever it ends: it is never {end}",
        location,
        notes=(f"it is described at {awaited.location}: let it restart on failure, or with a budget",),
    )


def _nodes(ready: Ready, written: ResolvedReady) -> Iterator[tuple[str | None, Value | None]]:
    """Yield the nodes that readiness asks for, by their full names, with what is written."""
    yield ready.node, written.node
    if ready.parameter is not None and written.parameter is not None:
        yield ready.parameter.node, written.parameter.node
    if ready.lifecycle is not None and written.lifecycle is not None:
        yield ready.lifecycle.node, written.lifecycle.node


class _Started:
    """The full names of the nodes of a plan, by what they end with and by their namespaces."""

    def __init__(self, names: Collection[str]) -> None:
        self.names = names
        self._by_last: dict[str, list[str]] = {}
        self._by_namespace: dict[str, list[str]] = {}
        for name in names:
            namespace, _, last = name.rpartition("/")
            self._by_last.setdefault(last, []).append(name)
            self._by_namespace.setdefault(namespace, []).append(last)
        self._near: dict[str, Names] = {}

    def near(self, name: str) -> list[str]:
        """Return the names that one is a slip for, in the namespace or in the name itself."""
        # Here, because few nodes are waited for by a name that none has.
        from orchestra.resolve.typos_among import Names  # noqa: PLC0415

        namespace, _, last = name.rpartition("/")
        found = [
            known
            for known in self._by_last.get(last, ())
            if not namespace or is_typo(namespace, known.rpartition("/")[0])
        ]
        if namespace not in self._near:
            self._near[namespace] = Names(self._by_namespace.get(namespace, ()))
        return [*found, *(f"{namespace}/{own}" for own in self._near[namespace].meant_by(last))]


def _check_node(
    name: str | None, place: Value | None, started: _Started, resolved: Resolved, problems: Problems
) -> None:
    """Report a node that is not of the plan where a near name is: others may be started elsewhere."""
    if not name or place is None or name in started.names or not is_mistake(name, started.names, resolved):
        return
    meant = started.near(name)
    if meant:
        message = f"no node of this plan is called '{name}'"
        problems.warning(Code.UNKNOWN_DEPENDENCY, message, place.location, suggestion=min(meant))
