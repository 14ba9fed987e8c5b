"""Comments of a file and what each stands with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from orchestra.convert.tree import NONE, Notes

if TYPE_CHECKING:
    from orchestra.description.entity import Entity


@dataclass(slots=True)
class Comments:
    """Comments by the entity that they stand with, and its field; each is given out once.

    Code may make several entities at one place: the first of them has the comments.
    """

    by_place: Mapping[tuple[object, str], Notes] = field(default_factory=dict)
    header: tuple[str, ...] = ()
    closing: tuple[str, ...] = ()
    _given: set[tuple[object, str]] = field(default_factory=set)

    def of(self, entity: Entity, name: str = "") -> Notes:
        """Return the comments of an entity, or of one of its fields."""
        key = (entity.span, name)
        if key in self._given or key not in self.by_place:
            return NONE
        self._given.add(key)
        return self.by_place[key]
