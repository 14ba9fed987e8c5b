"""What the remapping rules of a node make of a name, rule by rule: the first that matches counts (rcl, `remap.c`)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.plan.explained import Explained
from orchestra.plan.model import Candidate
from orchestra.resolve.names import expanded
from orchestra.resolve.remaps import identity, read_rule, remapped

if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Literal

    from orchestra.plan.model import Component, Process
    from orchestra.resolve.remaps import Rule

    Kind = Literal["topic", "service"]

# A node that has no name, or no namespace, in the description has one of its program's choice.
_UNKNOWN = "node_name"


def rules_for(record: Process | Component, name: str) -> list[Explained]:
    """Explain what becomes of a name: once where topics and services of that name go the same way, else of each.

    `name` may be what a rule says, `__node` and a scheme included. Raises `ValueError` where it cannot be a name.
    """
    rules = [read_rule(source, target) for source, target in record.remappings]
    asked = (
        read_rule(name, name if not name.startswith("__") else "x")
        if ":" in name or name.startswith("__")
        else None
    )
    if asked is not None and asked.kinds[0] in ("node", "namespace"):
        return [_own_name(record, rules, asked, name)]
    plain = asked.match if asked is not None else name
    kinds: Sequence[Kind] = [kind for kind in ("topic", "service") if asked is None or kind in asked.kinds]
    found = [_of_kind(record, rules, plain, kind) for kind in kinds]
    if len({(item.value, item.candidates) for item in found}) == 1:
        return found[:1]
    return [
        Explained(item.subject, item.name, item.value, item.candidates, f"as a {kind}")
        for item, kind in zip(found, kinds, strict=True)
    ]


def _of_kind(record: Process | Component, rules: Sequence[Rule], name: str, kind: Kind) -> Explained:
    namespace, node = identity(rules, record.namespace or "/", record.name or _UNKNOWN)
    whole = expanded(name, namespace, node)
    candidates, caught = [], None
    for index, rule in enumerate(rules):
        if kind not in rule.kinds and rule.kinds[0] in ("node", "namespace"):
            continue
        verdict, won = _verdict(rule, kind, whole, (namespace, node), caught)
        caught = index + 1 if won else caught
        candidates.append(_candidate(record, index, won, verdict))
    value = remapped(name, rules, namespace, node, kind)
    note = None if caught else f"no rule matches {whole}"
    return Explained("remapping", name, value, tuple(candidates), note)


def _verdict(
    rule: Rule, kind: Kind, whole: str, node: tuple[str, str], caught: int | None
) -> tuple[str, bool]:
    """Return what a rule does with a full name, and whether it is the one that counts."""
    namespace, name = node
    if rule.node not in (None, name):
        return f"only for nodes called '{rule.node}'", False
    if kind not in rule.kinds:
        return f"not for a {kind}", False
    match = expanded(rule.match, namespace, name)
    if match != whole:
        return f"matches {match}, not {whole}", False
    if caught is not None:
        return f"matches {whole} too, but rule {caught} comes first", False
    return f"the first rule that matches {whole}", True


def _candidate(record: Process | Component, index: int, won: bool, rule: str) -> Candidate:
    provenance = record.provenance
    source, target = record.remappings[index]
    through = provenance.remapping_values[index] if index < len(provenance.remapping_values) else ()
    location = provenance.remappings[index] if index < len(provenance.remappings) else record.location
    return Candidate(f"{source}:={target}", location, won, rule, through)


def _own_name(record: Process | Component, rules: Sequence[Rule], asked: Rule, name: str) -> Explained:
    """Explain the name or the namespace that rules give to the node itself."""
    candidates: list[Candidate] = []
    for index, rule in enumerate(rules):
        if rule.kinds == asked.kinds:
            first = not any(candidate.won for candidate in candidates)
            told = "the first rule that matches" if first else "an earlier rule comes first"
            candidates.append(_candidate(record, index, first, told))
    namespace, node = identity(rules, record.namespace or "/", record.name or _UNKNOWN)
    value = node if asked.kinds == ("node",) else namespace
    return Explained("remapping", name, value, tuple(candidates))
