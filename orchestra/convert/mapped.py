"""Descriptions with other texts in them: entities are frozen, so each one around a changed text is made anew."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias, TypeVar

from orchestra.description.entity import Entity
from orchestra.description.text import Call, Constant, Opaque, Template

Change: TypeAlias = Callable[[Template | Constant], Template | Constant | tuple[Template | Constant, ...]]
EntityT = TypeVar("EntityT", bound=Entity)


def mapped(entity: EntityT, change: Change) -> EntityT:
    """Return an entity in which every text is what `change` makes of it."""
    updates = {}
    for name in type(entity).model_fields:
        value = getattr(entity, name)
        other = _mapped(value, change)
        if other is not value:
            updates[name] = other
    return entity.model_copy(update=updates) if updates else entity


def _mapped(value: Any, change: Change) -> Any:  # noqa: ANN401 - a part of a description, whatever it is
    if isinstance(value, Template | Constant):
        return change(value)
    if isinstance(value, Entity):
        return mapped(value, change)
    if isinstance(value, tuple):
        items = tuple(_mapped(item, change) for item in value)
        return items if any(one is not other for one, other in zip(items, value, strict=True)) else value
    if isinstance(value, dict):
        return {key: _mapped(item, change) for key, item in value.items()}
    return value


def with_parts(template: Template, change: Callable[[Any], tuple[Any, ...]]) -> Template:
    """Return a text whose parts, those of arguments first, are what `change` makes of each."""
    parts: list[Any] = []
    for part in template.parts:
        inner = part
        if isinstance(part, Call):
            arguments = tuple(with_parts(item, change) for item in part.arguments)
            inner = part if arguments == part.arguments else Call(part.name, arguments, part.span)
        elif isinstance(part, Opaque):
            inner = Opaque(part.target, part.span, tuple(with_parts(item, change) for item in part.inside))
        parts += change(inner)
    if tuple(parts) == template.parts:
        return template
    return Template(tuple(parts), template.raw, template.span, template.quoted, template.faulty)
