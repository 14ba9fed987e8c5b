"""Values and types as people and YAML write them."""

from __future__ import annotations

import json
import math
import re
from typing import TYPE_CHECKING, Any

from orchestra.nearest import nearest
from orchestra.resolve.rcl.scalars import typed

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

_MOST_SHOWN = 12
_LONGEST = 60
_EXPONENT = re.compile(r"^(-?\d+)e")

_TYPES = {
    "bool": "a boolean",
    "integer": "an integer",
    "double": "a double",
    "string": "a string",
    "byte_array": "a list of bytes",
    "bool_array": "a list of booleans",
    "integer_array": "a list of integers",
    "double_array": "a list of doubles",
    "string_array": "a list of strings",
}


def shown(value: Any) -> str:  # noqa: ANN401 - any value of a schema
    """Return a value for a message: as YAML has it, cut where it is long."""
    text = f"'{value}'" if isinstance(value, str) else written(value)
    return text if len(text) <= _LONGEST else text[: _LONGEST - 1] + "…"


def written(value: Any) -> str:  # noqa: ANN401 - as above
    """Return a value as YAML has it, such that rcl reads its very type."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return _double(value)
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(written, value))}]"
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else str(value)


def _double(value: float) -> str:
    if not math.isfinite(value):
        return ".nan" if math.isnan(value) else ".inf" if value > 0 else "-.inf"
    return _EXPONENT.sub(r"\1.0e", repr(value))


def listed(values: Sequence[Any]) -> str:
    """Return values for a message, the first of many."""
    texts = [shown(value) for value in values[:_MOST_SHOWN]]
    return ", ".join([*texts, "…"] if len(values) > _MOST_SHOWN else texts)


def nearest_text(value: Any, texts: Iterable[str]) -> str | None:  # noqa: ANN401 - as above
    """Return the text that was probably meant, in quotes where it would be read as something else without them."""
    near = nearest(value, texts) if isinstance(value, str) else None
    return near if near is None or isinstance(typed(near), str) else written(near)


def types_of(types: Iterable[str]) -> str:
    """Return types for a message."""
    return " or ".join(_TYPES[item] for item in types)
