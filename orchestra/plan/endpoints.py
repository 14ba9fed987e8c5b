"""The topics, services and actions of a plan, as far as executables declare them: full names, and where from."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.declared.interfaces.files import interface_of
from orchestra.declared.interfaces.model import Endpoint
from orchestra.location import Location
from orchestra.resolve.model import ResolvedComponent
from orchestra.resolve.names import InvalidName, expanded
from orchestra.resolve.remaps import identity, read_rule, remapped

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from orchestra.declared.interfaces.model import Interface
    from orchestra.errors import Problems
    from orchestra.plan.model import Component, Process
    from orchestra.resolve.model import ResolvedProcess
    from orchestra.resolve.remaps import Rule

    Node = tuple[ResolvedProcess | ResolvedComponent, Process | Component]

# Stands for a name that is not known, in names that do not depend on it.
_UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class Placed:
    """An endpoint of a node of the plan by its full name.

    `location` is the target of the rule that gave it the name (`remapped`), else the node. `tuned`: parameters of the
    node change its quality of service.
    """

    node: str
    endpoint: Endpoint
    name: str
    location: Location
    remapped: bool = False
    tuned: bool = False


@dataclass(frozen=True, slots=True)
class Endpoints:
    """All that is known; `whole`: of every node of the plan."""

    placed: tuple[Placed, ...]
    whole: bool

    def of(self, *kinds: str) -> list[Placed]:
        """Return those of some kinds."""
        return [item for item in self.placed if item.endpoint.kind in kinds]


def endpoints_of(nodes: Iterable[Node], problems: Problems) -> Endpoints:
    """Return the endpoints of nodes; declarations that cannot be read are reported."""
    known: dict[tuple[str, str], Interface | None] = {}
    found: list[Placed] = []
    whole = True
    for node, planned in nodes:
        called = node.plugin if isinstance(node, ResolvedComponent) else node.executable
        if node.share is not None and (node.share, called) not in known:
            known[node.share, called] = interface_of(node.share, called, node.location, problems)
        interface = None if node.share is None else known[node.share, called]
        if interface is None or node.faulty:
            whole = False
        else:
            found += _placed(interface, node, planned)
    return Endpoints(tuple(found), whole)


def _placed(
    interface: Interface, node: ResolvedProcess | ResolvedComponent, planned: Process | Component
) -> Iterator[Placed]:
    rules = [read_rule(rule.source.text, rule.target.text) for rule in node.remaps]
    name = node.name.text if node.name is not None else interface.node
    space, name_known = identity(rules, node.namespace.text if node.namespace else "/", name or _UNKNOWN)
    for endpoint in interface.endpoints:
        if endpoint.name.startswith("~") and name is None:
            continue
        try:
            yield _one(endpoint, rules, space, name_known, node, planned)
        except InvalidName:
            continue  # no node can have such a name, so that the declaration is not of this one


def _one(
    endpoint: Endpoint,
    rules: list[Rule],
    space: str,
    name: str,
    node: ResolvedProcess | ResolvedComponent,
    planned: Process | Component,
) -> Placed:
    plain = expanded(endpoint.name, space, name)
    kind = "service" if endpoint.kind.startswith("service") else "topic"
    # The names of an action are made of several, which rules for it do not reach.
    acting = [] if endpoint.kind.startswith("action") else rules
    full = remapped(endpoint.name, acting, space, name, kind)  # type: ignore[arg-type]  # one of two words
    location, by_rule = node.location, False
    for rule, written in zip(acting, node.remaps, strict=False):
        if full != plain and remapped(endpoint.name, [rule], space, name, kind) == full:  # type: ignore[arg-type]
            location, by_rule = written.target.location, True
            break
    tuned = any(key.startswith(f"qos_overrides.{full}.") for key in planned.parameters)
    return Placed(planned.id, endpoint, full, location, by_rule, tuned)
