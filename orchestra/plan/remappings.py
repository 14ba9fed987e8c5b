"""Remapping rules that can never act."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.remaps import dead_rules, read_rule

if TYPE_CHECKING:
    from orchestra.errors import Problems
    from orchestra.resolve.model import ResolvedComponent, ResolvedProcess

_ROOT = "/"  # where hardly any program chooses another namespace


def check_remaps(process: ResolvedProcess | ResolvedComponent, problems: Problems) -> None:
    """Report rules that an earlier one, often of an outer scope, keeps from acting: the first that matches counts."""
    if len(process.remaps) < 2:  # noqa: PLR2004 - nothing stands before it
        return
    sources = {rule.source.text for rule in process.remaps}
    if len(sources) == len(process.remaps) and all(map(_is_apart, sources)):
        return
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


def _is_apart(source: str) -> bool:
    """Tell whether a name is a plain relative one, which no other one of that kind stands for."""
    return source.isidentifier() and not source.startswith("__")
