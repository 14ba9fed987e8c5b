"""Comments by what they stand with, for whoever writes it."""

from __future__ import annotations

from orchestra.convert.tree import NONE, Notes
from orchestra.dataclass import dataclass
from orchestra.description.entity import Entity
from orchestra.fields import field


@dataclass(slots=True)
class Comments:
    """Comments of entities and of their fields (an empty name: the entity itself), each given out once.

    `header` are those at the top of the file. Those that nobody has asked for stand at its end.
    """

    notes: dict[tuple[int, str], Notes] = field(default_factory=dict)
    header: tuple[str, ...] = ()
    at_end: tuple[str, ...] = ()

    def of(self, entity: Entity, name: str = "") -> Notes:
        """Return the comments of an entity, or of one of its fields."""
        return self.notes.pop((id(entity), name), NONE)

    def within(self, entity: Entity) -> Notes:
        """Return the comments of an entity and of all in it, which is written as one thing."""
        found = self.of(entity)
        for name in type(entity).model_fields:
            value = getattr(entity, name)
            inner = [self.of(entity, name)]
            parts = value if isinstance(value, tuple) else (value,)
            inner += [self.within(part) for part in parts if isinstance(part, Entity)]
            for notes in inner:
                found = joined(found, notes)
        return found

    @property
    def closing(self) -> tuple[str, ...]:
        """The comments for the end of the file, once all else is written."""
        left = [text for notes in self.notes.values() for text in (*notes.before, notes.beside) if text]
        return (*left, *self.at_end)


def joined(one: Notes, other: Notes) -> Notes:
    """Return the comments of two things that become one: only one can stand at the end of the line."""
    if other == NONE:
        return one
    aside = (other.beside,) if one.beside and other.beside else ()
    return Notes((*one.before, *other.before, *aside), one.beside or other.beside)
