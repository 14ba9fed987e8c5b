"""Messages as `message_to_yaml` and `message_to_csv` of rosidl_runtime_py are documented to write them, and odd ones."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path
from random import Random
from typing import Any

import yaml

_TEXTS = [
    "",
    "yes",
    "~",
    "1e3",
    "a: b",
    " lead",
    "it's",
    '"q"',
    "two\nlines",
    "é 漢 🚀",
    "=",
    "12:30",
    "x" * 200,
    "- a",
]
_NUMBERS = [0.0, -0.0, 1e20, 2.0**-24, float("nan"), float("inf"), -float("inf"), 0.5, 123456789.0]


class OddChance(Random):
    """Chance that has texts and numbers that are hard to write for those that are simple."""

    def choice(self, seq: Any) -> Any:
        """Return one of them."""
        return super().choice(_TEXTS if isinstance(seq[0], str) else _NUMBERS)


def message_names() -> list[str]:
    """Return the full names of all messages that are installed."""
    paths = sorted(Path(sys.prefix, "share").glob("*/msg/*.msg"))
    return [f"{path.parts[-3]}/msg/{path.stem}" for path in paths]


def message_class(name: str) -> Any:
    """Return the class of a message."""
    package, _, local = name.split("/")
    return getattr(import_module(f"{package}.msg"), local)


class _Writer(yaml.SafeDumper):
    """Writes the fields of a message in a line each, unless they stand in a list that is written in one line."""


_Writer.add_representer(
    dict,
    lambda writer, data: yaml.MappingNode(
        "tag:yaml.org,2002:map",
        [(writer.represent_data(name), writer.represent_data(value)) for name, value in data.items()],
    ),
)


def as_yaml(message: Any, length: int | None, *, flow: bool) -> str:
    """Return a message as YAML; arrays and texts are cut at a length."""
    return yaml.dump(
        _fields(message, length),
        Dumper=_Writer,
        allow_unicode=True,
        width=sys.maxsize,
        default_flow_style=flow,
        sort_keys=False,
    )


def as_csv(message: Any, length: int | None) -> str:
    """Return a message as values between commas."""
    written = ""
    for name in message.get_fields_and_field_types():
        written += ("," if written else "") + _between_commas(getattr(message, name), length)
    return written


def _fields(message: Any, length: int | None) -> dict[str, Any]:
    names = message.get_fields_and_field_types()
    return {name: _shown(getattr(message, name), length) for name in names}


def _shown(value: Any, length: int | None) -> Any:
    if hasattr(value, "get_fields_and_field_types"):
        return _fields(value, length)
    if isinstance(value, bytes | str):
        text = value if isinstance(value, str) else value.decode("latin-1")
        return text if length is None or len(text) <= length else f"{text[:length]}..."
    if not hasattr(value, "__len__"):
        return value.item() if hasattr(value, "item") else value
    items = [_shown(item, length) for item in value]
    return items if length is None or len(items) <= length else [*items[:length], "..."]


def _between_commas(value: Any, length: int | None) -> str:
    if hasattr(value, "get_fields_and_field_types"):
        return as_csv(value, length)
    if isinstance(value, bytes | str):
        cut = length is not None and len(value) > length
        end: Any = "..." if isinstance(value, str) else b"..."
        return str(value[:length] + end if cut else value)
    if not hasattr(value, "__len__"):
        return str(value)
    written = ""
    for place, item in enumerate(value):
        over = length is not None and place >= length
        written += ("," if written else "") + ("..." if over else _between_commas(item, length))
        if over:
            break
    return written
