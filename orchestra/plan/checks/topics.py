"""Names of topics that differ only in case or in a slash, between nodes that look meant for each other.

Known are the names that a description writes: what nodes are remapped to, and what is waited for. One is a mistake
only where nobody else uses it and another node uses the other.
"""

from __future__ import annotations

from operator import attrgetter, itemgetter
from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.dataclass import dataclass, maker
from orchestra.errors import Code
from orchestra.plan.ids import domains_of
from orchestra.resolve.context import Value
from orchestra.resolve.names import InvalidName, expanded, full_name

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from orchestra.errors import Problems
    from orchestra.plan.model import Component, Plan, Process
    from orchestra.resolve.model import Resolved, ResolvedComponent, ResolvedProcess

    _Planned: TypeAlias = Process | Component
    _Written: TypeAlias = ResolvedProcess | ResolvedComponent

_PAIR: Final = 2
_RULES: Final = attrgetter("namespace", "remappings")
_READY: Final = attrgetter("ready")
_TARGET: Final = itemgetter(1)
_OWN: Final = frozenset("~{\n")  # in a name: it has that of its node in it, or is none
_GLOBAL: Final = frozenset({"tf", "tf_static", "clock", "rosout", "parameter_events", "diagnostics"})
# What is told where nodes say which topics they have.
_KNOWN: Final = frozenset({Code.TOPIC_TYPE, Code.UNFED_TOPIC})


@dataclass(frozen=True, slots=True)
class _Use:
    """A full name that a node uses, as it is written."""

    name: str
    written: Value
    node: str
    namespace: str


_new_use = maker(_Use)


def check_topics(resolved: Resolved, plan: Plan, problems: Problems) -> None:
    """Report names that nobody else uses beside nearly the same one of another node."""
    if _cannot_meet(resolved, plan):
        return
    uses = list(_uses(resolved, plan))
    told: set[object] = {problem.span for problem in problems if problem.code in _KNOWN}
    domains = domains_of(resolved)
    if domains is None:
        _check_domain(uses, plan, told, problems)
        return
    of_nodes = {planned.id: domains[id(written)] for planned, written in _pairs(resolved, plan)}
    for domain in dict.fromkeys(of_nodes.values()):  # nodes of two never meet
        _check_domain([use for use in uses if of_nodes[use.node] == domain], plan, told, problems)


def _cannot_meet(resolved: Resolved, plan: Plan) -> bool:
    """Tell whether all names together are apart as those of a domain are in `_are_apart`, without a look at each.

    Names that are not looked at later are among them, and such as a node's own name is part of are left to that.
    """
    rules: dict[str, list[tuple[str, str]]] = {}
    for namespace, remappings in map(_RULES, (*plan.processes, *plan.components)):
        if remappings:
            rules.setdefault(namespace or "/", []).extend(remappings)
    if any(map(_READY, resolved.processes)):
        return False
    names: set[str] = set()
    below_root: set[str] = set()
    for namespace, pairs in rules.items():
        written = set(map(_TARGET, pairs))
        if not _OWN.isdisjoint("".join(written)):
            return False
        begin = full_name(namespace, "")
        names.update([text if text.startswith("/") else begin + text for text in written])
        if namespace != "/":
            below_root.update(["/" + text for text in written])
    alike = "\n".join(names).replace("/", "").lower().split("\n")
    if names and not len({*alike}) == len(alike) == len(names):
        return False
    return names.isdisjoint(below_root)


def _check_domain(uses: Sequence[_Use], plan: Plan, told: set[object], problems: Problems) -> None:
    """Report such names of nodes that may meet."""
    if _are_apart(uses):
        return
    users: dict[str, set[str]] = {}
    for use in uses:
        users.setdefault(use.name, set()).add(use.node)
    for alike in _alike(uses, plan):
        _check(alike, users, told, problems)


def _check(uses: Iterable[_Use], users: dict[str, set[str]], told: set[object], problems: Problems) -> None:
    """Report the last of some names that are nearly the same, of those that nobody else uses."""
    uses = list(uses)
    lonely = [use for use in uses if len(users[use.name]) == 1]
    for use in reversed(lonely):
        other = next((it for it in uses if it.name != use.name and users[it.name] != {use.node}), None)
        if other is None or use.written.location.span in told:
            continue
        told.add(use.written.location.span)
        message = f"'{use.name}' is used by '{use.node}' alone, and '{other.name}' by '{other.node}'"
        problems.warning(
            Code.SPLIT_TOPIC,
            message,
            use.written.location,
            suggestion=other.written.text if other.namespace == use.namespace else other.name,
            notes=(f"the other name is at {other.written.location}",),
        )
        return


def _alike(uses: Iterable[_Use], plan: Plan) -> Iterator[list[_Use]]:
    """Yield the uses of names that differ only in case or in a slash, where there are several names.

    Of nodes in different namespaces these are names of several levels, one with a slash before it, one without: a
    single level, as `scan`, is often the same for each of several robots and for none. What stands below the name of
    a node is its own.
    """
    groups: dict[object, list[_Use]] = {}
    apart: dict[str, list[_Use]] = {}
    for use in uses:
        groups.setdefault(use.name.replace("/", "").lower(), []).append(use)
        bare = use.written.text.removeprefix("/")
        plain = use.name in (f"/{bare}", f"{use.namespace}/{bare}")
        if plain and use.namespace != "/" and bare not in _GLOBAL:
            groups.setdefault((use.namespace, bare), []).append(use)
        if plain and "/" in bare:
            apart.setdefault(bare, []).append(use)
    for group in groups.values():
        if len({use.name for use in group}) > 1:
            yield group
    nodes: set[str] | None = None
    for bare, group in apart.items():
        names = {use.name for use in group} if len(group) > 1 else ()
        if len(names) == _PAIR and f"/{bare}" in names:
            nodes = _names(plan) if nodes is None else nodes
            if all(nodes.isdisjoint(_above(name)) for name in names):
                yield group


def _are_apart(uses: Sequence[_Use]) -> bool:
    """Return whether no two names differ only in case and slashes, or in the namespace before them: see `_alike`."""
    names = {use.name for use in uses}
    if len({name.replace("/", "").lower() for name in names}) < len(names):
        return False
    return names.isdisjoint([f"/{use.written.text}" for use in uses if use.namespace != "/"])


def _names(plan: Plan) -> set[str]:
    """Return the full names of all nodes."""
    planned: tuple[_Planned, ...] = (*plan.processes, *plan.components)
    return {f"{item.namespace or ''}/{item.name}".replace("//", "/") for item in planned}


def _above(name: str) -> Iterator[str]:
    """Yield the names that a name stands below, but for the root."""
    while name := name.rpartition("/")[0]:
        yield name


def _uses(resolved: Resolved, plan: Plan) -> Iterator[_Use]:
    for planned, written in _pairs(resolved, plan):
        if written.remaps and not written.faulty:
            yield from _remapped(planned, written)
    waited = [
        pair for pair in zip(plan.processes, resolved.processes, strict=True) if pair[1].ready is not None
    ]
    for process, item in waited:
        if process.ready is None or item.ready is None:
            continue
        awaited = ((process.ready.message, item.ready.message), (process.ready.topic, item.ready.topic))
        for name, value in awaited:
            if name is not None and value is not None:
                yield _Use(name, value, process.id, process.namespace or "/")


def _pairs(resolved: Resolved, plan: Plan) -> Iterator[tuple[_Planned, _Written]]:
    """Yield the processes and components of a plan, each with what it was resolved to."""
    yield from zip(plan.processes, resolved.processes, strict=True)
    yield from zip(plan.components, resolved.components, strict=True)


def _remapped(planned: _Planned, written: _Written) -> Iterator[_Use]:
    namespace = planned.namespace or "/"
    for rule in written.remaps:
        if rule.source.text.rpartition(":")[2].startswith("__"):
            continue
        try:
            name = expanded(rule.target.text, namespace, planned.name or "_")
        except InvalidName:
            continue
        yield _new_use(name, rule.target, planned.id, namespace)
