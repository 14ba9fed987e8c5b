"""Which process waits for which: names become ids, and what can never come about is reported."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code, Problems
from orchestra.nearest import nearest
from orchestra.plan.absent import is_mistake
from orchestra.plan.conditions import Dependency
from orchestra.resolve.names import InvalidName, expanded

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from orchestra.resolve.model import Resolved, ResolvedDependency, ResolvedProcess, ResolvedSkip


# The actions that start a process.
_STARTED: Final = frozenset({"node", "lifecycle_node", "node_container", "executable"})
# What lets a process be waited for until it is ready, by whether it is brought to its active state.
_CURES: Final = {False: "a `ready`", True: "`ready: {lifecycle: active}`, say"}


class Targets:
    """The processes of a plan by what a dependency may call them, which few descriptions have."""

    def __init__(self, resolved: Resolved, ids: Sequence[str], full: Sequence[str | None]) -> None:
        self.resolved = resolved
        self.process = dict(zip(ids, resolved.processes, strict=True))
        self.full = full  # names of those that are nodes

    @cached_property
    def nodes(self) -> dict[str, list[str]]:
        """Those that are nodes by their full names."""
        found: dict[str, list[str]] = {}
        for identity, full in zip(self.process, self.full, strict=True):
            if full is not None:
                found.setdefault(full, []).append(identity)
        return found

    @cached_property
    def names(self) -> dict[str, list[str]]:
        """The processes by their ids, and by what they are called."""
        found: dict[str, list[str]] = {}
        for identity, process in self.process.items():
            called = process.label or process.executable
            found.setdefault(identity, []).append(identity)
            if called != identity:
                found.setdefault(called, []).append(identity)
        return found

    @cached_property
    def programs(self) -> dict[str, list[str]]:
        """The full names of nodes by their executables, each once."""
        found: dict[str, dict[str, None]] = {}
        for node, owners in self.nodes.items():
            for owner in owners:
                found.setdefault(self.process[owner].executable, {})[node] = None
        return {executable: list(nodes) for executable, nodes in found.items()}

    @cached_property
    def labels(self) -> dict[str, list[str]]:
        """The processes by the labels of what they are in."""
        found: dict[str, list[str]] = {}
        for identity, process in self.process.items():
            for label in process.labels:
                found.setdefault(label, []).append(identity)
        return found

    @cached_property
    def left_out(self) -> dict[str | None, ResolvedSkip]:
        """The first action of each name that its condition leaves out."""
        found: dict[str | None, ResolvedSkip] = {}
        for item in self.resolved.skipped:
            if item.action in _STARTED:
                found.setdefault(item.name, item)
        return found

    @cached_property
    def actions(self) -> dict[int, list[str]]:
        """The processes inside of each object of a Python launch file: as many for each as includes are deep."""
        found: dict[int, list[str]] = {}
        for identity, process in self.process.items():
            for action in {id(outer) for outer in process.around}:
                found.setdefault(action, []).append(identity)
        return found


def dependencies(
    process: ResolvedProcess, identity: str, targets: Targets, problems: Problems
) -> tuple[Dependency, ...]:
    """Return what a process waits for. What is not there is reported, unless the process may do without it."""
    edges: dict[tuple[str, str], Dependency] = {}
    for written in process.depends_on:
        found = _found(written, process, targets)
        if not found and written.required:
            _report_unknown(written, process, targets, problems)
        for target in found:
            if target == identity and len(found) > 1:
                continue  # a label covers the process that waits for the others
            if written.condition == "ready":
                _check_ready(written, target, targets, problems)
            edge = Dependency(
                target, written.condition, written.timeout, written.name.location, written.required
            )
            known = edges.setdefault((target, written.condition), edge)
            if edge.required and not known.required:
                edges[target, written.condition] = edge
    return tuple(edges.values())


def check_cycles(edges: Mapping[str, tuple[Dependency, ...]], problems: Problems) -> None:
    """Report processes that wait for each other, each in one circle at the most."""
    if not any(edges.values()):
        return
    from orchestra.plan.circles import circles  # noqa: PLC0415 - only where something waits

    graph = {identity: dict.fromkeys(edge.process for edge in waits) for identity, waits in edges.items()}
    for circle in circles(graph):
        way = " waits for ".join(reversed(circle))
        edge = next(edge for edge in edges[circle[1]] if edge.process == circle[0])
        problems.error(Code.DEPENDENCY_CYCLE, f"these wait for each other: {way}", edge.location)


def _found(written: ResolvedDependency, process: ResolvedProcess, targets: Targets) -> list[str]:
    name = written.name.text
    if written.kind == "action":
        return targets.actions.get(id(written.action), [])
    if written.kind == "node":
        return targets.nodes.get(_full(name, process), [])
    return (targets.labels if written.kind == "label" else targets.names).get(name, [])


def _full(name: str, process: ResolvedProcess) -> str:
    namespace = process.namespace.text if process.namespace is not None else "/"
    try:
        return expanded(name, namespace, process.name.text if process.name is not None else "_")
    except InvalidName:
        return name


def _report_unknown(
    written: ResolvedDependency, process: ResolvedProcess, targets: Targets, problems: Problems
) -> None:
    if written.kind == "action":
        _report_idle(written, targets, problems)
        return
    known = {"node": targets.nodes, "process": targets.names, "label": targets.labels}[written.kind]
    name = _full(written.name.text, process) if written.kind == "node" else written.name.text
    if not is_mistake(name, known, targets.resolved):
        return
    what = {"node": "node", "process": "process", "label": "include with the label"}[written.kind]
    left_out = targets.left_out.get(written.name.text.rpartition("/")[2])
    if left_out is not None:
        message = f"the {what} '{name}' is left out: its `{left_out.condition}` is {left_out.value}"
        notes = (f"it is described at {left_out.location}",)
        problems.error(Code.UNKNOWN_DEPENDENCY, message, written.name.location, notes=notes)
        return
    problems.error(
        Code.UNKNOWN_DEPENDENCY,
        f"there is no {what} '{name}' to wait for",
        written.name.location,
        suggestion=_as_written(nearest(name, known) or _of_program(name, targets), written, process),
    )


def _of_program(name: str, targets: Targets) -> str | None:
    """Return the one node whose executable is called so: it is waited for by its own name."""
    found = targets.programs.get(name.rpartition("/")[2], ())
    return found[0] if len(found) == 1 else None


def _as_written(meant: str | None, written: ResolvedDependency, process: ResolvedProcess) -> str | None:
    """Return a name in the form in which another one is written: relative, where it is in the namespace of that."""
    if meant is None or written.kind != "node" or written.name.text.startswith("/"):
        return meant
    namespace = _full("_", process).removesuffix("_")
    return meant.removeprefix(namespace)


def _report_idle(written: ResolvedDependency, targets: Targets, problems: Problems) -> None:
    """Report an action of which no process has come; where something was left out for its faults, it may be that."""
    if targets.resolved.incomplete or any(process.faulty for process in targets.resolved.processes):
        return
    message = f"no process comes out of the {written.name.text} to wait for"
    reason = "it is not in the launch description, or its condition leaves it out"
    problems.error(Code.UNKNOWN_DEPENDENCY, message, written.name.location, notes=(reason,))


def _check_ready(written: ResolvedDependency, target: str, targets: Targets, problems: Problems) -> None:
    awaited = targets.process[target]
    if awaited.ready is None and not awaited.faulty:
        problems.error(
            Code.NEVER_READY,
            f"'{target}' does not say when it is ready",
            written.name.location,
            notes=(f"it is described at {awaited.location}: give it {_CURES[awaited.autostart]}",),
        )
