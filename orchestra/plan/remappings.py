"""Remapping rules that can never act."""

from __future__ import annotations

from functools import lru_cache
from operator import attrgetter, itemgetter
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.resolve.remaps import dead_rules, read_rule

if TYPE_CHECKING:
    from orchestra.errors import Problems
    from orchestra.resolve.model import ResolvedComponent, ResolvedProcess

_ROOT = "/"  # where hardly any program chooses another namespace
_TEXTS: Final = attrgetter("texts")
_FIRST: Final = itemgetter(0)


def remappings(node: ResolvedProcess | ResolvedComponent, problems: Problems) -> tuple[tuple[str, str], ...]:
    """Return the rules of a node in order of effect, as texts. One that can never act is reported."""
    rules: tuple[tuple[str, str], ...] = tuple(map(_TEXTS, node.remaps))
    if len(rules) > 1 and not _are_apart(tuple(map(_FIRST, rules))):
        _check(node, problems)
    return rules


@lru_cache(maxsize=256)  # nodes that are alike have rules for the same names
def _are_apart(sources: tuple[str, ...]) -> bool:
    """Tell whether names are plain relative ones, of which none stands for another, as most are."""
    plain = len({*sources}) == len(sources) and all(map(str.isidentifier, sources))
    return plain and not any(source.startswith("__") for source in sources)


def _check(process: ResolvedProcess | ResolvedComponent, problems: Problems) -> None:
    """Report rules that an earlier one, often of an outer scope, keeps from acting: the first that matches counts."""
    rules = [read_rule(rule.source.text, rule.target.text) for rule in process.remaps]
    namespace = process.namespace.text if process.namespace is not None else _ROOT
    for dead in dead_rules(rules, namespace, process.name.text if process.name is not None else None):
        rule, earlier = process.remaps[dead.rule], process.remaps[dead.caught_by]
        location = rule.source.location
        if rule.target.text == earlier.target.text:
            continue
        begin = f"'{rule.source.text}' is remapped to "
        if any(told.startswith(begin) for told in problems.messages(Code.DEAD_REMAP, location.span)):
            continue  # of another node that the same lines make
        problems.warning(
            Code.DEAD_REMAP,
            f"{begin}'{earlier.target.text}' before this rule is reached",
            location,
            notes=(f"the rule that counts is at {earlier.source.location}",),
        )
