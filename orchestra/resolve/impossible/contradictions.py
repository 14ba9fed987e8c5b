"""Conditions that contradict another one around them in the same file: what they stand on never comes about."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.description.text import Call, Template, Words
from orchestra.errors import Code
from orchestra.resolve.impossible.held import Form, Held
from orchestra.resolve.mentions import variables_in
from orchestra.resolve.substitutions.equality import equal

if TYPE_CHECKING:
    from orchestra.resolve.context import Evaluated
    from orchestra.resolve.resolution import Resolution


def held(template: Template, run: Resolution, *, truth: bool) -> Held | None:
    """Return what a condition that has just been found true says; None for one that other code decides."""
    names = variables_in(template)
    form, truth, compared = _simplified(template, truth=truth)
    if form is None or not names:
        return None  # constants are how people switch something off
    values = tuple((name, _value(name, run)) for name in sorted(names))
    return Held(form, truth, compared, values, run.at(template.span))


def check_contradiction(template: Template, run: Resolution, *, truth: bool) -> None:
    """Report a condition, found false, that cannot be true inside of those around it."""
    mine = held(template, run, truth=truth) if run.held else None
    if mine is None:
        return
    for outer in run.held:
        if _contradict(outer, mine):
            message = "this is never true here: a condition around it says the contrary"
            notes = (f"it is at {outer.location}",)
            run.problems.warning(Code.IMPOSSIBLE_CONDITION, message, mine.location, notes=notes)
            return


def _contradict(outer: Held, inner: Held) -> bool:
    same_file = outer.location.span.file == inner.location.span.file
    if not same_file or outer.location.included_from != inner.location.included_from:
        return False
    if outer.form != inner.form or not _same_values(outer, inner):
        return False
    if outer.compared is None or inner.compared is None:
        return outer.compared == inner.compared and outer.truth != inner.truth
    alike = equal(outer.compared, inner.compared)
    return outer.truth != inner.truth if alike else outer.truth and inner.truth


def _same_values(outer: Held, inner: Held) -> bool:
    """Return whether nothing that they read has been set anew in between."""
    return all(one is other for (_, one), (_, other) in zip(outer.values, inner.values, strict=True))


def _value(name: str, run: Resolution) -> Evaluated | None:
    variable = run.scope.variables.get(name)
    return None if variable is None else variable.value


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
