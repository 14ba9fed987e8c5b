"""Texts that stand for numbers, evaluated; and how any text that cannot be meant is reported."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from orchestra.errors import Code
from orchestra.resolve.context import Poison, Value
from orchestra.resolve.refusals import refuse_value

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.description.ranges import Range
    from orchestra.description.text import Template
    from orchestra.resolve.resolution import Resolution

_T = TypeVar("_T")


class UnfitError(ValueError):
    """A text that cannot stand where it does: the reason, and what was probably meant."""

    def __init__(self, reason: str, suggestion: str | None = None, notes: tuple[str, ...] = ()) -> None:
        super().__init__(reason)
        self.reason = reason
        self.suggestion = suggestion
        self.notes = notes


def amount(template: Template | None, bounds: Range, run: Resolution) -> float | Poison | None:
    """Return the number that a text comes to; one that is not within the bounds is reported."""
    return made(template, lambda text: _within(text, bounds), run)


def whole(template: Template | None, bounds: Range, run: Resolution) -> int | Poison | None:
    """Return the whole number that a text comes to; one that is not within the bounds is reported."""
    return made(template, lambda text: int(_within(text, bounds)), run)


def made(template: Template | None, make: Callable[[str], _T], run: Resolution) -> _T | Poison | None:
    """Return what is made of the text that a template comes to, None for None; `UnfitError` is reported."""
    value = run.evaluate(template)
    if not isinstance(value, Value):
        return value
    try:
        return make(value.text)
    except UnfitError as error:
        return refuse_value(
            value, run.problems, Code.BAD_VALUE, error.reason, meant=error.suggestion, notes=error.notes
        )


def _within(text: str, bounds: Range) -> float:
    number = bounds.read(text)
    if number is None:
        raise UnfitError(f"expected {bounds.wanted}, found '{text}'")
    return number
