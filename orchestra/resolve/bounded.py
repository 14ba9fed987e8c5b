"""What is set again and again for all that follows: of one name so much is kept, and no more.

Each of a thousand files may set the same variable, parameter or rule. To each of a thousand nodes all of them would
belong, though but one counts.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Container

    from orchestra.resolve.model import EnvironmentChange, InlineParameter, ParameterSource, ResolvedRemap

_MOST: Final = 64


def with_change(
    changes: tuple[EnvironmentChange, ...], change: EnvironmentChange
) -> tuple[EnvironmentChange, ...]:
    """Return the changes of a variable with one more, which is the one that counts: without the oldest of many."""
    return (*changes[-_MOST + 1 :], change)


def with_parameter(
    parameters: tuple[ParameterSource, ...], parameter: InlineParameter, names: Container[str]
) -> tuple[ParameterSource, ...]:
    """Return what is set for all nodes with a parameter more; `names` has those of the others.

    Of many values for it the second is left out: the first has its place among the patterns, and the last one counts.
    """
    if len(parameters) >= _MOST and parameter.name in names:
        each = [getattr(item, "name", None) for item in parameters]
        if each.count(parameter.name) >= _MOST:
            second = each.index(parameter.name, each.index(parameter.name) + 1)
            parameters = parameters[:second] + parameters[second + 1 :]
    return (*parameters, parameter)


def with_rule(rules: tuple[ResolvedRemap, ...], rule: ResolvedRemap) -> tuple[ResolvedRemap, ...]:
    """Return the rules for all nodes with one more, or as they are where they have it many times: it could not act.

    It is looked for now and then, for most rules differ.
    """
    if rules and len(rules) % _MOST == 0:
        words = rule.source.text, rule.target.text
        if sum((item.source.text, item.target.text) == words for item in rules) >= _MOST:
            return rules
    return (*rules, rule)
