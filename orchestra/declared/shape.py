"""Dotted names of parameters in the nested objects of a JSON Schema, and back.

`limits.max` may be a property `max` of an object `limits`, or a property of that whole name: the schema says which. So
the tree that is validated is built along the schema; where it says nothing, a dot is a level.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.declared.plain_schema import NUMERIC, ROS_TYPE, TYPES

if TYPE_CHECKING:
    from orchestra.declared.model import RosType

Schema: TypeAlias = Mapping[str, Any]
# From a reference to what it refers to, and what is looked up from there.
Lookup: TypeAlias = Callable[[str], tuple[Any, "Lookup"]]

_BRANCHES = ("allOf", "anyOf", "oneOf")
_SINGLE = ("if", "then", "else")


@dataclass(frozen=True, slots=True, eq=False)
class Level:
    """All that may be said of one object: schemas that apply to it, together or by choice.

    Beside each is what its references are looked up with.
    """

    schemas: tuple[tuple[Schema, Lookup], ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The properties that are named."""
        return tuple(
            dict.fromkeys(name for schema, _ in self.schemas for name in _part(schema, "properties"))
        )

    def below(self, name: str) -> Level | None:
        """Return what is said of a property that is named."""
        found = [
            (_part(schema, "properties")[name], lookup)
            for schema, lookup in self.schemas
            if name in _part(schema, "properties")
        ]
        return level(*found) if found else None

    def by_pattern(self, name: str) -> Level | None:
        """Return what is said of a property by patterns of its name."""
        found = [
            (inner, lookup)
            for schema, lookup in self.schemas
            for pattern, inner in _part(schema, "patternProperties").items()
            if re.search(pattern, name)
        ]
        return level(*found) if found else None

    @property
    def others(self) -> Level | None:
        """What is said of properties that are not named, None where it is nothing but yes or no."""
        found = [
            (schema["additionalProperties"], lookup)
            for schema, lookup in self.schemas
            if isinstance(schema.get("additionalProperties"), Mapping)
        ]
        return level(*found) if found else None

    @property
    def open(self) -> bool | None:
        """Whether others may be there, None where nothing is said."""
        keys = ("additionalProperties", "unevaluatedProperties")
        said = [schema[key] for schema, _ in self.schemas for key in keys if key in schema]
        return None if not said else all(item is not False for item in said)

    @property
    def is_object(self) -> bool:
        """Whether it is about something with properties."""
        return any("properties" in schema or schema.get("type") == "object" for schema, _ in self.schemas)


def level(*schemas: tuple[Any, Lookup]) -> Level:
    """Return what schemas say together, with all that they refer to."""
    seen: set[int] = set()
    return Level(tuple(item for schema, lookup in schemas for item in _said(schema, lookup, seen)))


def _said(schema: Any, lookup: Lookup, seen: set[int]) -> Iterator[tuple[Schema, Lookup]]:  # noqa: ANN401 - whatever a file holds
    """Yield a schema and those that apply with it, each once: they may refer to each other in a circle."""
    if not isinstance(schema, Mapping) or id(schema) in seen:
        return
    seen.add(id(schema))
    yield schema, lookup
    if isinstance(schema.get("$ref"), str):
        yield from _said(*lookup(schema["$ref"]), seen)
    inner = [schema[key] for key in _SINGLE if key in schema]
    for key in _BRANCHES:
        inner += schema[key] if isinstance(schema.get(key), list) else []
    for item in inner:
        yield from _said(item, lookup, seen)


def _part(schema: Schema, key: str) -> Mapping[str, Any]:
    part = schema.get(key)
    return part if isinstance(part, Mapping) else {}


@dataclass(frozen=True, slots=True)
class Place:
    """The way to a parameter in the tree, and what is said of it; `known` tells whether anything is.

    Of one that is not known, `beside` are the full names of those that are, on the level where it goes wrong.
    """

    way: tuple[str, ...]
    said: Level | None
    known: bool
    beside: tuple[str, ...] = ()


def place(name: str, at: Level) -> Place:
    """Return where a parameter belongs: as much of its name as the schema knows is one step."""
    parts = name.split(".")
    for end in range(len(parts), 0, -1):
        head, rest = ".".join(parts[:end]), ".".join(parts[end:])
        inner = at.below(head)
        if inner is not None:
            return _inside(head, rest, inner)
    whole, first = at.by_pattern(name), at.by_pattern(parts[0])
    if whole is not None and not (whole.is_object and len(parts) > 1):
        return Place((name,), whole, known=True)
    if (
        first is not None and len(parts) > 1
    ):  # a pattern without an end fits the whole name of what is below it too
        return _inside(parts[0], ".".join(parts[1:]), first)
    others = at.others
    if others is not None and others.is_object and len(parts) > 1:
        return _inside(parts[0], ".".join(parts[1:]), others)
    if others is not None:
        return Place((name,), others, known=True)
    flat = len(parts) == 1 or any("." in other for other in at.names)
    return Place((name,) if flat else tuple(parts), None, known=False, beside=at.names)


def _inside(head: str, rest: str, inner: Level) -> Place:
    if not rest:
        return Place((head,), inner, known=True)
    found = place(rest, inner)
    return Place(
        (head, *found.way), found.said, found.known, tuple(f"{head}.{other}" for other in found.beside)
    )


def tree(values: Mapping[str, Any], places: Mapping[str, Place]) -> dict[str, Any]:
    """Return values by dotted name as the tree that the schema is about."""
    made: dict[str, Any] = {}
    for name, value in values.items():
        *above, last = places[name].way
        inner: Any = made
        for step in above:
            inner = inner.setdefault(step, {}) if isinstance(inner, dict) else {}
        if isinstance(inner, dict):
            inner[last] = list(value) if isinstance(value, tuple) else value
    return made


def ros_types(said: Level) -> tuple[tuple[RosType, ...], tuple[RosType, ...]]:
    """Return the types that are meant, and those that the schema would take beside them; none where nothing is said."""
    exact = [word for schema, _ in said.schemas for word in _words(schema.get(ROS_TYPE)) if word in TYPES]
    if exact:
        return tuple(exact), ()
    meant: list[Any] = []
    beside: list[Any] = []
    for schema, _ in said.schemas:
        for word in _words(schema.get("type")):
            items = schema.get("items") if word == "array" else None
            inner = _words(items.get("type")) if isinstance(items, Mapping) else []
            for kind in [f"{item}_array" for item in inner] if word == "array" else [word]:
                element, _, suffix = kind.partition("_")
                if element in NUMERIC:
                    one, other = NUMERIC[element]
                    end = f"_{suffix}" if suffix else ""
                    meant.append(one + end)
                    beside += [] if other is None else [other + end]
    return tuple(dict.fromkeys(meant)), tuple(dict.fromkeys(beside))


def _words(value: Any) -> list[Any]:  # noqa: ANN401 - whatever a file holds
    return value if isinstance(value, list) else [] if value is None else [value]
