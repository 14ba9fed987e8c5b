"""Substitutions of ours that the launch language cannot say: they perform themselves in Python."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.described import described
from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.place import IN_CONSTRUCTOR, here
from orchestra.compat.text import template
from orchestra.description.text import Opaque

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.description.text import Part
    from orchestra.location import Span


class PerformedSubstitution(Substitution):
    """A substitution with a place of its own; it is known what it is made of.

    One `_of_the_moment` reads what only the event knows that is being handled.
    """

    _of_the_moment = False

    def __init__(self) -> None:
        self._place = here(self, IN_CONSTRUCTOR)

    def _made_of(self) -> Sequence[Sequence[Substitution]]:
        """Return the texts that performing it evaluates."""
        return ()

    def _parts(self, span: Span) -> tuple[Part, ...]:  # noqa: ARG002 - it has a place of its own
        place = self._place.span
        return (Opaque(self, place, tuple(template(item, place) for item in self._made_of())),)


class Concatenated(Substitution):
    """Several substitutions as one."""

    def __init__(self, subs: Sequence[Substitution]) -> None:
        self._subs = tuple(subs)

    def describe(self) -> str:
        """Return the descriptions of all."""
        return described(self._subs)

    def perform(self, context: LaunchContext) -> str:
        """Return the texts of all, without anything between them."""
        return "".join(item.perform(context) for item in self._subs)

    def _parts(self, span: Span) -> tuple[Part, ...]:
        perform: Any = type(self).perform
        if not perform.__module__.startswith("orchestra.compat."):
            return super()._parts(span)
        return tuple(part for item in self._subs for part in item._parts(span))

    def _raw(self) -> str:
        return "".join(item._raw() for item in self._subs)
