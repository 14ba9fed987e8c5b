"""Fields that hold other actions, and the values an action is repeated for."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import Field, InstanceOf, WithJsonSchema

from orchestra.description.entity import Action
from orchestra.description.fields import AnyValue

ForEach: TypeAlias = Annotated[
    dict[str, AnyValue],
    Field(min_length=1),
    WithJsonSchema(
        {
            "type": "object",
            "minProperties": 1,
            "additionalProperties": {
                "type": ["array", "string"],
                "items": {"type": ["string", "number", "boolean"]},
            },
        }
    ),
]
Children: TypeAlias = Annotated[tuple[InstanceOf[Action], ...], WithJsonSchema({"type": "array"})]
