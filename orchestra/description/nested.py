"""Fields that hold other actions, and the values an action is repeated for."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import InstanceOf, PlainValidator, ValidationInfo, WithJsonSchema
from pydantic_core import PydanticCustomError

from orchestra.description.entity import Action
from orchestra.description.fields import any_value
from orchestra.description.source import kind_of
from orchestra.description.text import Template

ForEachValues: TypeAlias = dict[str, Template | tuple[Template, ...]]


def _for_each(value: object, info: ValidationInfo) -> ForEachValues:
    if not isinstance(value, dict) or not value:
        raise PydanticCustomError(
            "wrong_type", "expected variables with lists of values, found {found}", {"found": kind_of(value)}
        )
    return {name: any_value(values, info) for name, values in value.items()}


ForEach: TypeAlias = Annotated[
    ForEachValues,
    PlainValidator(_for_each),
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
