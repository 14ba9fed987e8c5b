"""Fields that hold other actions, and the values an action is repeated for."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from orchestra.description.entity import Action
from orchestra.description.fields import AnyValue
from orchestra.description.marks import Instance, NotEmpty, Told

ForEach: TypeAlias = Annotated[
    dict[str, AnyValue],
    NotEmpty(),
    Told(
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
Children: TypeAlias = Annotated[tuple[Annotated[Action, Instance()], ...], Told({"type": "array"})]
