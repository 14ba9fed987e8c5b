"""Values that work out where they stand when somebody asks: most are only ever read as texts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.location import Location, location_of
from orchestra.resolve.context import Value

if TYPE_CHECKING:
    from orchestra.description.text import MatchedTemplate
    from orchestra.location import Span
    from orchestra.resolve.context import Read


class LateValue(Value):
    """A value that works out its place when somebody asks, which few do; equal to any other that says the same."""

    __slots__ = ()

    def __new__(cls, *values: Any, **named: Any) -> Value:  # type: ignore[misc] # noqa: ANN401 - any field
        """Return an ordinary one: what is made of it with a change has values of its own."""
        return Value(*values, **named)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Value) or not (type(other) is Value or isinstance(other, LateValue)):
            return NotImplemented
        return self.text == other.text and self.location == other.location

    __hash__ = Value.__hash__

    def __repr__(self) -> str:
        return repr(_ordinary(self.text, self.location, self.through, self.verbatim, self.raw))

    def __reduce__(self) -> Any:  # noqa: ANN401 - what makes it, and of what
        return _ordinary, (self.text, self.location, self.through, self.verbatim, self.raw)


class PlacedValue(LateValue):
    """A text that stands for another value, in its place."""

    __slots__ = ("of",)

    verbatim = False
    raw = None
    of: Value

    @property
    def location(self) -> Location:
        """The place."""
        return self.of.location


def placed_value(text: str, of: Value, through: tuple[Read, ...]) -> Value:
    """Return a text in the place of another value."""
    made: Any = _new(PlacedValue)
    made.text = text
    made.of = of
    made.through = through
    value: Value = made
    return value


class MatchedValue(LateValue):
    """What a text comes to that stands where the group of a match does."""

    __slots__ = ("included_from", "template")

    template: MatchedTemplate
    included_from: tuple[Span, ...]

    @property
    def location(self) -> Location:
        """The place."""
        return location_of(self.template.matched, self.template.group, self.included_from)

    @property
    def verbatim(self) -> bool:
        """Whether it stands there as it is."""
        return self.template.constant is not None

    @property
    def raw(self) -> str | None:
        """What stands there, where that is something else."""
        return None if self.verbatim else self.template.raw


def _ordinary(
    text: str, location: Location, through: tuple[Read, ...], verbatim: bool, raw: str | None
) -> Value:
    return Value(text, location, through=through, verbatim=verbatim, raw=raw)


_new = object.__new__


def matched_value(
    text: str, template: MatchedTemplate, included_from: tuple[Span, ...], through: tuple[Read, ...] = ()
) -> Value:
    """Return what a text comes to, in a file that these includes have led to."""
    made: Any = _new(MatchedValue)
    made.text = text
    made.template = template
    made.included_from = included_from
    made.through = through
    value: Value = made
    return value
