"""Entities and lists of entities as one list."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from orchestra.compat.launch.some_entities_type import SomeEntitiesType


def normalize_to_list_of_entities(
    entities: SomeEntitiesType | Iterable[SomeEntitiesType],
) -> list[LaunchDescriptionEntity]:
    """Return the entities, those of lists within the list too. Raises `TypeError` for anything else."""
    if isinstance(entities, LaunchDescriptionEntity):
        return [entities]
    found: list[LaunchDescriptionEntity] = []
    for item in entities:
        found += [item] if isinstance(item, LaunchDescriptionEntity) else map(_entity, _several(item))
    return found


def _several(item: object) -> Iterable[object]:
    return item if isinstance(item, Iterable) and not isinstance(item, str) else [item]


def _entity(item: object) -> LaunchDescriptionEntity:
    if isinstance(item, LaunchDescriptionEntity):
        return item
    raise TypeError(f"expected an action or another entity, found {type(item).__name__}: {item!r}")
