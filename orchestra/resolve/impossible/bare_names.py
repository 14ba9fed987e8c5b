"""Comparisons of two constants of which one is the name of an argument: `$(equals mode sim)` for `$(var mode)`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.description.text import Call, MatchedTemplate
from orchestra.errors import Code
from orchestra.load.nested import Nested
from orchestra.resolve.impossible.conditions_alike import may_be_bare
from orchestra.resolve.mentions import performed_in

if TYPE_CHECKING:
    from orchestra.description.text import Template
    from orchestra.resolve.resolution import Resolution

_COMPARISONS: Final = ("equals", "not-equals")


def check_bare_names(template: Template, run: Resolution) -> None:
    """Tell of such names in a condition, which are compared as the texts that they are."""
    if (
        type(template) is MatchedTemplate
        and isinstance(template.pieces, Nested)
        and not may_be_bare(template.pieces)
    ):
        return
    for part in performed_in(template):
        if not isinstance(part, Call) or part.name not in _COMPARISONS:
            continue
        first = part.arguments[0]
        if not first.quoted and first.raw.endswith(",") and not first.faulty:
            message = f"the comma is a part of '{first.raw}': arguments stand apart by blanks alone"
            at = run.at(first.span)
            run.problems.warning(Code.IMPOSSIBLE_CONDITION, message, at, suggestion=first.raw.rstrip(","))
            continue
        texts = [argument.constant for argument in part.arguments]
        named = [argument for argument in part.arguments if argument.constant in run.scope.variables]
        if None in texts or len(set(texts)) < len(texts) or len(named) != 1:
            continue
        message = f"'{named[0].raw}' is compared as a text, not as the argument of that name"
        at = run.at(named[0].span)
        run.problems.warning(Code.IMPOSSIBLE_CONDITION, message, at, suggestion=f"$(var {named[0].constant})")
