"""Alternatives of a JSON Schema told apart by type, so that an editor points at what is wrong.

A validator that fails on `anyOf` can only say that nothing fits. Where the alternatives are of different types, the
value itself says which of them is meant, and what is told is what is wrong with that one.
"""

from __future__ import annotations

from typing import Any, TypeAlias

Schema: TypeAlias = dict[str, Any]

_CONTAINERS = {"array", "object"}
# What concerns values of every type: it cannot stand beside what is for another type.
_UNTYPED = {"$ref", "anyOf", "enum", "const", "if"}
_TYPES = {str: "string", bool: "boolean", int: "integer", float: "number"}


def told_apart(schema: Any) -> Any:  # noqa: ANN401 - any part of a schema
    """Return a part of a schema with `anyOf` replaced, at every level, where the types of its alternatives differ."""
    if isinstance(schema, list):
        return [told_apart(item) for item in schema]
    if not isinstance(schema, dict):
        return schema
    inner = {key: told_apart(value) for key, value in schema.items()}
    alternatives = inner.pop("anyOf", None)
    if alternatives is None:
        return inner
    merged = _merged(_by_type(alternatives))
    return {**inner, "anyOf": alternatives} if merged is None else {**merged, **inner}


def _by_type(alternatives: list[Schema]) -> list[Schema]:
    """Return the alternatives, those for one and the same type put together."""
    found: dict[str, list[Schema]] = {}
    for alternative in alternatives:
        found.setdefault(str(_types(alternative)), []).append(alternative)
    return [items[0] if len(items) == 1 else _together(items) for items in found.values()]


def _together(items: list[Schema]) -> Schema:
    (kind,) = _types(items[0])
    return {
        "type": kind,
        "anyOf": [{key: value for key, value in item.items() if key != "type"} for item in items],
    }


def _types(schema: Schema) -> tuple[str, ...]:
    """Return the types that a schema is for."""
    if "$ref" in schema:
        return ("object",)
    named = schema.get("type")
    if named is None:
        return tuple(sorted({_TYPES[type(value)] for value in schema.get("enum", ())}))
    return tuple(named) if isinstance(named, list) else (named,)


def _merged(alternatives: list[Schema]) -> Schema | None:
    """Return one schema for alternatives of different types, None where one type has several."""
    types = [name for alternative in alternatives for name in _types(alternative)]
    if len(types) > len(set(types)) or not types:
        return None
    containers = [item for item in alternatives if set(_types(item)) <= _CONTAINERS]
    scalars = {key: value for item in alternatives if item not in containers for key, value in item.items()}
    kind = types if len(types) > 1 else types[0]
    flat = {key: value for item in containers for key, value in item.items()} | scalars
    if not _UNTYPED & flat.keys():
        return {**flat, "type": kind}
    rest = {key: value for key, value in scalars.items() if key not in ("type", "description")}
    words = [word for item in (rest, *rest.get("anyOf", ())) for word in item.get("enum", ())]
    for item in containers:
        rest = {"if": {"type": _types(item)[0]}, "then": item, **({"else": rest} if rest else {})}
    # Editors do not look behind conditions for words to propose.
    return {"type": kind, **rest, **({"examples": words} if words else {})}
