"""Remap rules, applied as rcl applies them: the first rule that matches counts, its result is not remapped again.

Source: measured with rclpy 7.1.6 (`tests/data/rcl-probes.jsonl`), rcl `remap.c`.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TYPE_CHECKING, Final, Literal, TypeAlias

from orchestra.dataclass import dataclass, maker
from orchestra.patterns import pattern
from orchestra.resolve.names import (
    Fault,
    InvalidName,
    expanded,
    namespace_fault,
    node_name_fault,
    rule_name_fault,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

Kind: TypeAlias = Literal["topic", "service", "node", "namespace"]

_LEFT = pattern(r"(?:(?P<node>[^:/]*):(?!//))?(?P<scheme>rostopic://|rosservice://)?(?P<match>.*)", re.DOTALL)
_NAMES: Final = ("topic", "service")
_KINDS: Final[dict[str | None, tuple[Kind, ...]]] = {
    None: _NAMES,
    "rostopic://": ("topic",),
    "rosservice://": ("service",),
}
_OWN: Final[dict[str, tuple[Kind, ...]]] = {
    "__node": ("node",),
    "__name": ("node",),
    "__ns": ("namespace",),
}


@dataclass(frozen=True, slots=True)
class Rule:
    """One `from:=to`: for nodes called `node` only where that is given, for the `kinds` of names."""

    node: str | None
    kinds: tuple[Kind, ...]
    match: str
    replacement: str


new_rule = maker(Rule)


@dataclass(frozen=True, slots=True)
class DeadRule:
    """The rule at index `rule` never acts, because the one at index `caught_by` comes first."""

    rule: int
    caught_by: int


@lru_cache(maxsize=4096)  # rules are read where they are resolved, and again where they are checked
def read_rule(source: str, target: str) -> Rule:
    """Read a remapping `source:=target`. Raises `InvalidName`, for the side that cannot be."""
    plain = ":" not in source and "__" not in source  # for a topic or a service of any node, as most
    if plain and rule_name_fault(source) is None and rule_name_fault(target) is None:
        return new_rule(None, _NAMES, source, target)
    found = _LEFT.fullmatch(source)
    if found is None:
        raise InvalidName(source, Fault("it is no remap rule", 0))
    node, scheme, match = found["node"], found["scheme"], found["match"]
    if node is not None:
        _accept(source, node_name_fault(node), 0)
    own = _OWN.get(match) if scheme is None else None
    if own is None:
        _accept(source, rule_name_fault(match), found.start("match"))
        _accept(target, rule_name_fault(target), 0)
        return new_rule(node, _KINDS[scheme], match, target)
    _accept(target, namespace_fault(target) if own == ("namespace",) else node_name_fault(target), 0)
    return new_rule(node, own, match, target)


def identity(rules: Sequence[Rule], namespace: str, name: str) -> tuple[str, str]:
    """Return the namespace and the name that a node has after the rules `__ns` and `__node`."""
    named = _first(rules, "node", name)
    placed = _first(rules, "namespace", named or name)
    return placed or namespace, named or name


def remapped(
    name: str, rules: Sequence[Rule], namespace: str, node: str, kind: Literal["topic", "service"] = "topic"
) -> str:
    """Return the full name that a node gets for a topic or service name.

    `namespace` and `node` are the remapped ones. Raises `InvalidName` where the name cannot be one.
    """
    whole = expanded(name, namespace, node)
    for rule in rules:
        if _applies(rule, kind, node) and expanded(rule.match, namespace, node) == whole:
            return expanded(rule.replacement, namespace, node)
    return whole


def dead_rules(rules: Sequence[Rule], namespace: str | None, node: str | None) -> tuple[DeadRule, ...]:
    """Return the rules that an earlier rule keeps from ever acting on this node.

    Where the node's name or namespace is not known, an unknown stands for it on all sides alike.
    """
    seen: dict[tuple[Kind, str], int] = {}
    dead: list[DeadRule] = []
    for index, rule in enumerate(rules):
        if rule.node not in (None, node):
            continue
        whole = expanded(rule.match, namespace or "/?", node or "?") if rule.kinds[0] in _NAMES else ""
        taken = [seen.setdefault((kind, whole), index) for kind in rule.kinds]
        if index not in taken:
            dead.append(DeadRule(index, min(taken)))
    return tuple(dead)


def _first(rules: Sequence[Rule], kind: Kind, node: str) -> str | None:
    return next((rule.replacement for rule in rules if _applies(rule, kind, node)), None)


def _applies(rule: Rule, kind: Kind, node: str) -> bool:
    return kind in rule.kinds and rule.node in (None, node)


def _accept(text: str, fault: Fault | None, start: int) -> None:
    if fault is not None:
        raise InvalidName(text, Fault(fault.reason, start + fault.offset))
