"""Conditions that contradict another one around them in the same file: what they stand on never comes about."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.description.text import Call, Template, Words
from orchestra.errors import Code
from orchestra.location import Location
from orchestra.resolve.impossible.held import Form, Held, Said
from orchestra.resolve.mentions import variables_in
from orchestra.resolve.substitutions.equality import equal

if TYPE_CHECKING:
    from orchestra.resolve.resolution import Resolution


def held(template: Template, run: Resolution, *, truth: bool) -> Held:
    """Return a condition that has just been evaluated."""
    return Held(template, run.context.included_from, run.scope, truth=truth)


def check_contradiction(template: Template, run: Resolution, *, truth: bool) -> None:
    """Report a condition, found false, that cannot be true inside of those around it."""
    mine = _said(held(template, run, truth=truth)) if run.held else None
    if mine is None:
        return
    for condition in run.held:
        outer = _said(condition)
        if outer is not None and _contradict(outer, mine):
            message = "this is never true here: a condition around it says the contrary"
            notes = (f"it is at {outer.location}",)
            run.problems.warning(Code.IMPOSSIBLE_CONDITION, message, mine.location, notes=notes)
            return


def _said(condition: Held) -> Said | None:
    """Return what a condition says; None for one that other code decides."""
    if condition.said is None:
        condition.said = (_worked_out(condition),)
    return condition.said[0]


def _worked_out(condition: Held) -> Said | None:
    template = condition.template
    names = variables_in(template)
    form, truth, compared = _simplified(template, truth=condition.truth)
    if form is None or not names:
        return None  # constants are how people switch something off
    values = tuple((name, condition.value(name)) for name in sorted(names))
    return Said(form, truth, compared, values, Location(template.span, condition.chain))


def _contradict(outer: Said, inner: Said) -> bool:
    same_file = outer.location.span.file == inner.location.span.file
    if not same_file or outer.location.included_from != inner.location.included_from:
        return False
    if outer.form != inner.form or not _same_values(outer, inner):
        return False
    if outer.compared is None or inner.compared is None:
        return outer.compared == inner.compared and outer.truth != inner.truth
    alike = equal(outer.compared, inner.compared)
    return outer.truth != inner.truth if alike else outer.truth and inner.truth


def _same_values(outer: Said, inner: Said) -> bool:
    """Return whether nothing that they read has been set anew in between."""
    return all(one is other for (_, one), (_, other) in zip(outer.values, inner.values, strict=True))


def _simplified(template: Template, *, truth: bool) -> tuple[Form | None, bool, str | None]:
    """Return the form of a condition, whether that is to be true, and the constant that it is compared with."""
    match template.parts:
        case (Call(name="not", arguments=(inner,)),):
            return _simplified(inner, truth=not truth)
        case (Call(name="equals" | "not-equals" as name, arguments=(one, other)),):
            if other.constant is None:
                one, other = other, one
            if other.constant is not None and one.constant is None:
                return _form(one), truth is (name == "equals"), other.constant
    return _form(template), truth, None


def _form(template: Template) -> Form | None:
    parts: list[str | tuple[str, tuple[Form, ...]]] = []
    for part in template.parts:
        if isinstance(part, Words):
            parts.append(part.text)
        elif isinstance(part, Call):
            inner = [_form(argument) for argument in part.arguments]
            known = tuple(form for form in inner if form is not None)
            if len(known) < len(inner):
                return None
            parts.append((part.name, known))
        else:
            return None
    return tuple(parts)
