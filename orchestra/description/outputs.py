"""Where the output of a process goes: one word for all of it, or places by stream."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

from orchestra.description.core import PydanticCustomError, ValidationError
from orchestra.description.fields import STRAY_KEY, items_of, placed_in, word
from orchestra.description.marks import Plain, Told
from orchestra.description.text import Template
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from pydantic_core.core_schema import ValidationInfo

OUTPUTS = ("screen", "log", "both", "own_log", "full")
STREAMS = ("stdout", "stderr", "both")
PLACES = ("screen", "log", "own_log")

_word = word(
    *OUTPUTS, elsewhere={"console": "screen", "file": "log", "stdout": "screen", "terminal": "screen"}
)
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
    if not value:
        wanted = {"wanted": ", ".join(STREAMS), "found": "no key"}
        raise PydanticCustomError("wrong_type", "expected streams ({wanted}), found {found}", wanted)
    return {stream: _stream(stream, places, info) for stream, places in value.items()}


def _stream(stream: str, places: object, info: ValidationInfo) -> tuple[Template, ...]:
    """Read the places of one stream; a fault is one of its key or of its places."""
    if stream not in STREAMS:
        facts = {"wanted": ", ".join(STREAMS), "stray": stream, "suggestion": nearest(stream, STREAMS)}
        error = PydanticCustomError(STRAY_KEY, "expected streams ({wanted}), found '{stray}'", facts)
        raise placed_in((stream,), error, places)
    try:
        return _places(places, info)
    except PydanticCustomError as error:
        raise placed_in((stream,), error, places) from None
    except ValidationError as error:
        (inner,) = error.errors(include_url=False)
        again = PydanticCustomError("wrong_type", "{said}", {"said": inner["msg"], **inner.get("ctx", {})})
        raise placed_in((stream, *inner["loc"]), again, inner["input"]) from None


def _places(value: object, info: ValidationInfo) -> tuple[Template, ...]:
    if isinstance(value, list | tuple):
        return items_of(value, _place, info)
    return (_place(value, info),)


Output: TypeAlias = Annotated[Template | dict[str, tuple[Template, ...]], Plain(_output), Told(_SCHEMA)]
