"""Entities of a description with those that stand in them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.description.entity import Entity

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator


def entities_below(entities: Iterable[Entity]) -> Iterator[Entity]:
    """Yield each entity, and after it those in its lists."""
    for entity in entities:
        yield entity
        for name in type(entity).model_fields:
            value = getattr(entity, name)
            if isinstance(value, tuple):
                yield from entities_below(item for item in value if isinstance(item, Entity))
