"""JSON Schema of frozen dataclasses, as `orchestra.plan.codec` writes them.

Not made by pydantic's TypeAdapter: its text changes with pydantic's version, the committed schemas must not, and
the places of locations and problems are flattened on their way to JSON.
"""

from __future__ import annotations

import dataclasses
import inspect
import types
import typing
from enum import Enum
from typing import Any, TypeAlias

from orchestra.errors import Problem
from orchestra.location import Location

Schema: TypeAlias = dict[str, Any]

DIALECT = "https://json-schema.org/draft/2020-12/schema"
_PLAIN = {str: "string", bool: "boolean", int: "integer", float: "number", type(None): "null"}
_LINES = ("line", "column", "end_line", "end_column")
_COUNTED: Schema = {"type": "integer", "minimum": 1}


def record_schema(kind: Any) -> Schema:  # noqa: ANN401 - a type of any form
    """Return the schema of a dataclass or of a union of them, complete with the definitions it needs."""
    definitions: dict[str, Schema] = {}
    root = _schema(kind, definitions)
    name = root.get("$ref", "").removeprefix("#/$defs/")
    if name:
        root = definitions.pop(name)
    return {"$schema": DIALECT, **root, "$defs": dict(sorted(definitions.items()))}


def _schema(kind: Any, definitions: dict[str, Schema]) -> Schema:  # noqa: ANN401 - a type of any form
    origin, alternatives = typing.get_origin(kind), typing.get_args(kind)
    if kind in _PLAIN:
        return {"type": _PLAIN[kind]}
    if kind is Any:
        return {}
    if origin is typing.Literal:
        return {"const": alternatives[0]} if len(alternatives) == 1 else {"enum": list(alternatives)}
    if origin in (types.UnionType, typing.Union):
        return _any_of([_schema(item, definitions) for item in alternatives])
    if origin is tuple:
        return _list(alternatives, definitions)
    if origin in (dict, typing.get_origin(typing.Mapping[str, str])):
        return {"type": "object", "additionalProperties": _schema(alternatives[1], definitions)}
    return _defined(kind, definitions)


def _any_of(alternatives: list[Schema]) -> Schema:
    """Return the union, in its short form where every alternative is a type of its own."""
    if all(list(item) == ["type"] for item in alternatives):
        return {"type": [item["type"] for item in alternatives]}
    return {"anyOf": alternatives}


def _list(items: tuple[Any, ...], definitions: dict[str, Schema]) -> Schema:
    if items[-1] is Ellipsis:
        return {"type": "array", "items": _schema(items[0], definitions)}
    schemas = [_schema(item, definitions) for item in items]
    return {"type": "array", "prefixItems": schemas, "items": False, "minItems": len(items)}


def _defined(kind: Any, definitions: dict[str, Schema]) -> Schema:  # noqa: ANN401 - a type of any form
    """Return a reference to a named type, and see that it is defined."""
    if kind.__name__ not in definitions:
        definitions[kind.__name__] = {}  # stands here already for a type that contains itself
        definitions[kind.__name__] = _definition(kind, definitions)
    return {"$ref": f"#/$defs/{kind.__name__}"}


def _definition(kind: Any, definitions: dict[str, Schema]) -> Schema:  # noqa: ANN401 - a type of any form
    if kind is Location:
        return _object(
            kind, {"file": {"type": "string"}, **dict.fromkeys(_LINES, _COUNTED), **_chain(definitions)}
        )
    if kind is Problem:
        return _problem(definitions)
    if issubclass(kind, Enum):
        return {"description": _summary(kind), "enum": [member.value for member in kind]}
    hints = typing.get_type_hints(kind)
    return _object(
        kind, {entry.name: _schema(hints[entry.name], definitions) for entry in dataclasses.fields(kind)}
    )


def _object(kind: Any, properties: dict[str, Schema]) -> Schema:  # noqa: ANN401 - a type of any form
    return {
        "title": kind.__name__,
        "description": _summary(kind),
        "type": "object",
        "properties": properties,
        "required": list(properties),
        "additionalProperties": False,
    }


def _problem(definitions: dict[str, Schema]) -> Schema:
    hints = typing.get_type_hints(Problem)
    counted_or_null = {**_COUNTED, "type": ["integer", "null"]}
    return _object(
        Problem,
        {
            **{name: _schema(hints[name], definitions) for name in ("code", "severity", "message")},
            "file": {"type": ["string", "null"]},
            **dict.fromkeys(_LINES, counted_or_null),
            **{name: _schema(hints[name], definitions) for name in ("suggestion", "notes")},
            **_chain(definitions),
        },
    )


def _chain(definitions: dict[str, Schema]) -> dict[str, Schema]:
    """Return the property that lists the includes."""
    definitions["Place"] = {
        "description": "Where an include action stands.",
        "type": "object",
        "properties": {"file": {"type": "string"}, "line": _COUNTED, "column": _COUNTED},
        "required": ["file", "line", "column"],
        "additionalProperties": False,
    }
    return {"included_from": {"type": "array", "items": {"$ref": "#/$defs/Place"}}}


def _summary(kind: type) -> str:
    """Return the docstring's text, its paragraphs unwrapped."""
    paragraphs = inspect.cleandoc(kind.__doc__ or "").split("\n\n")
    return "\n\n".join(" ".join(paragraph.split()) for paragraph in paragraphs)
