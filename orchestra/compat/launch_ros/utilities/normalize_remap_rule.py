"""Remapping rules with both sides as substitutions."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from orchestra.compat.explanation import told
from orchestra.compat.text import normalized
from orchestra.compat.wrong import WrongType

if TYPE_CHECKING:
    from orchestra.compat.launch.substitution import Substitution

_SIDES = 2


def normalize_remap_rule(remap_rule: Any) -> tuple[tuple[Substitution, ...], tuple[Substitution, ...]]:
    """Return the two sides of a rule. Raises `TypeError` for anything but a pair in a tuple, as upstream."""
    if not isinstance(remap_rule, tuple) or len(remap_rule) != _SIDES:
        raise TypeError(f"a remapping is a tuple of two names, not {_shown(remap_rule)}")
    source, target = remap_rule
    return tuple(normalized(source)), tuple(normalized(target))


def _shown(rule: Any) -> str:
    """Return what stands in place of a rule; a set has no order of its own."""
    return told(rule) if isinstance(rule, set) else repr(rule)


def normalize_remap_rules(
    remap_rules: Any,
) -> tuple[tuple[tuple[Substitution, ...], tuple[Substitution, ...]], ...]:
    """Return the two sides of several rules. Raises `TypeError` for anything but pairs in tuples."""
    if not isinstance(remap_rules, Iterable):
        raise WrongType(f"remappings are a list of tuples of two names, not {remap_rules!r}", remap_rules)
    if isinstance(remap_rules, Mapping):
        told_so = "remappings are a list of tuples of two names, not a dict: list(its.items()) is one"
        raise WrongType(told_so, remap_rules)
    if _is_one_rule(remap_rules):
        told_so = f"remappings are a list of tuples of two names, this is one of them: {remap_rules!r}"
        raise WrongType(told_so, remap_rules)
    return tuple(normalize_remap_rule(rule) for rule in remap_rules)


def _is_one_rule(rules: Iterable[Any]) -> bool:
    """Return whether names stand where rules are expected: a tuple of them, or as many in a list as a rule has."""
    if not isinstance(rules, list | tuple) or not rules or not all(isinstance(item, str) for item in rules):
        return False
    return isinstance(rules, tuple) or len(rules) == _SIDES
