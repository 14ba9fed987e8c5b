"""Where the output of a process goes: one word for all of it, or places by stream."""

from __future__ import annotations

from typing import Annotated, Any, TypeAlias

from pydantic import PlainValidator, ValidationInfo, WithJsonSchema
from pydantic_core import PydanticCustomError

from orchestra.description.fields import items_of, word
from orchestra.description.text import Template

OUTPUTS = ("screen", "log", "both", "own_log", "full")
STREAMS = ("stdout", "stderr", "both")
PLACES = ("screen", "log", "own_log")

_word = word(*OUTPUTS)
_place = word(*PLACES)

_PLACE = {"enum": list(PLACES)}
_PLACES = {"anyOf": [_PLACE, {"type": "array", "items": _PLACE}]}
_SCHEMA: dict[str, Any] = {
    "anyOf": [
        {"enum": list(OUTPUTS)},
        {"type": "string", "pattern": r"\$\("},
        {
            "type": "object",
            "properties": dict.fromkeys(STREAMS, _PLACES),
            "additionalProperties": False,
            "minProperties": 1,
        },
    ]
}


def _output(value: object, info: ValidationInfo) -> Template | dict[str, tuple[Template, ...]]:
    if not isinstance(value, dict):
        return _word(value, info)
    stray = next((key for key in value if key not in STREAMS), None)
    if stray is not None or not value:
        found = f"'{stray}'" if stray is not None else "no key"
        wanted = {"wanted": ", ".join(STREAMS), "found": found}
        raise PydanticCustomError("wrong_type", "expected streams ({wanted}), found {found}", wanted)
    return {stream: _places(places, info) for stream, places in value.items()}


def _places(value: object, info: ValidationInfo) -> tuple[Template, ...]:
    if isinstance(value, list | tuple):
        return items_of(value, _place, info)
    return (_place(value, info),)


Output: TypeAlias = Annotated[
    Template | dict[str, tuple[Template, ...]], PlainValidator(_output), WithJsonSchema(_SCHEMA)
]
