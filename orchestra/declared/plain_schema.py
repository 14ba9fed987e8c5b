"""JSON Schemas that say no more than what ROS can say of parameters, read without the library.

Most schemas are so, and all that `orchestra schema capture` writes; the library takes longer to import than many a
launch file to be planned. What reads alike must mean alike: a test compares with the library.

Of ROS's own, which JSON Schema has no words for, `x-ros-type` has the type (or a list of them) and `x-ros-step` the
distance of allowed values from `minimum`.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final, get_args

from orchestra.dataclass import dataclass
from orchestra.declared.model import Declarations, Parameter, RosType, Undeclared
from orchestra.declared.rules import OneOf, Range, Rule, Size, Unique
from orchestra.fields import field

if TYPE_CHECKING:
    from collections.abc import Mapping

ROS_TYPE: Final = "x-ros-type"
ROS_STEP: Final = "x-ros-step"
TYPES: Final[tuple[RosType, ...]] = get_args(RosType)
# By JSON's word: what it means, and what the schema would take beside it.
NUMERIC: Final[dict[str, tuple[RosType, RosType | None]]] = {
    "boolean": ("bool", None),
    "integer": ("integer", "double"),
    "number": ("double", "integer"),
    "string": ("string", None),
}
_SAID: Final = frozenset(
    {"$schema", "$id", "$comment", "title", "description", "default", "examples", "deprecated", "readOnly"}
)
_LIMITS: Final = frozenset({"minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum", ROS_STEP})
_OBJECT: Final = _SAID | {"type", "properties", "patternProperties", "required", "additionalProperties"}
_SCALAR: Final = _SAID | _LIMITS | {"type", "enum", "const", "minLength", "maxLength", ROS_TYPE}
_LIST: Final = _SAID | {"type", "items", "minItems", "maxItems", "uniqueItems", ROS_TYPE}
_ITEM: Final = _SAID | _LIMITS | {"type", "enum"}


class NotPlainError(Exception):
    """The schema says more; the library knows what."""


def read_plain(schema: Any) -> Declarations | None:  # noqa: ANN401 - whatever a file holds
    """Return what a schema declares, None where it says more than can be read here, or is none."""
    if not isinstance(schema, dict) or schema.get("type", "object") != "object":
        return None
    found = _Found()
    try:
        undeclared = _level(schema, "", found, outermost=True)
    except NotPlainError:
        return None
    return Declarations(tuple(found.parameters), tuple(found.patterns), (), undeclared)


@dataclass(slots=True)
class _Found:
    parameters: list[Parameter] = field(default_factory=list)
    patterns: list[tuple[str, Parameter]] = field(default_factory=list)


def _level(schema: Mapping[str, Any], above: str, found: _Found, *, outermost: bool) -> Undeclared:
    """Read the properties of an object; those of one inside it are parameters with a dot in their names."""
    known = {key for key in schema if not _is_extension(key)}
    if not known <= _OBJECT or (not outermost and not {"type", "properties"} <= known):
        raise NotPlainError
    properties, patterns = _mapping(schema, "properties"), _mapping(schema, "patternProperties")
    required, more = schema.get("required", []), schema.get("additionalProperties")
    if not isinstance(required, list) or not set(map(str, required)) <= set(properties):
        raise NotPlainError
    if (more is not None and not isinstance(more, bool)) or (patterns and not outermost):
        raise NotPlainError
    undeclared: Undeclared = "ignored" if more is None else "allowed" if more else "refused"
    for name, inner in properties.items():
        if inner.get("type") != "object":
            found.parameters.append(_parameter(inner, f"{above}{name}", required=name in required))
        # Levels are one table here: they must say the same of what is not declared, and may all be absent.
        elif (
            name in required
            or inner.get("required")
            or "." in name
            or patterns
            or _level(inner, f"{above}{name}.", found, outermost=False) != undeclared
        ):
            raise NotPlainError
    for pattern, inner in patterns.items():
        expression = _expression(pattern)
        if any(expression.search(name) for name in properties):
            raise NotPlainError
        found.patterns.append((pattern, _parameter(inner, pattern, required=False)))
    return undeclared


def _mapping(schema: Mapping[str, Any], key: str) -> dict[str, Any]:
    """Return the schemas of properties."""
    value = schema.get(key, {})
    if not isinstance(value, dict) or not all(isinstance(inner, dict) for inner in value.values()):
        raise NotPlainError
    if not all(isinstance(name, str) and name for name in value):
        raise NotPlainError
    return value


def _expression(pattern: str) -> re.Pattern[str]:
    try:
        return re.compile(pattern)
    except re.error:
        raise NotPlainError from None


def _parameter(schema: Mapping[str, Any], name: str, *, required: bool) -> Parameter:
    known = {key for key in schema if key in (ROS_TYPE, ROS_STEP) or not _is_extension(key)}
    word = schema.get("type")
    if word == "array":
        types, tolerated, rules = _list(schema, known)
    elif known <= _SCALAR and (word is None or (isinstance(word, str) and word in NUMERIC)):
        types, tolerated, rules = _scalar(schema, word)
    else:
        raise NotPlainError
    own = _ros_types(schema)
    return Parameter(
        name=name,
        types=own or types,
        tolerated=() if own else tolerated,
        required=required,
        description=str(schema.get("description", "")),
        read_only=schema.get("readOnly") is True,
        rules=rules,
    )


_Read = tuple[tuple[RosType, ...], tuple[RosType, ...], tuple[Rule, ...]]


def _scalar(schema: Mapping[str, Any], word: str | None) -> _Read:
    if word is None and not {ROS_TYPE, "enum", "const"} & schema.keys() and len(set(schema) - _SAID) > 0:
        raise NotPlainError  # limits of whatever is a number
    rules = [*_limits(schema), *_choice(schema, items=False)]
    size = _size(schema, "minLength", "maxLength")
    if size is not None and word != "string":
        raise NotPlainError
    rules += [] if size is None else [size]
    if word is None:
        return (), (), tuple(rules)
    meant, beside = NUMERIC[word]
    return (meant,), () if beside is None else (beside,), tuple(rules)


def _list(schema: Mapping[str, Any], known: set[str]) -> _Read:
    items = schema.get("items", {})
    if (
        not known <= _LIST
        or not isinstance(items, dict)
        or not isinstance(schema.get("uniqueItems", False), bool)
    ):
        raise NotPlainError
    inner = {key for key in items if key == ROS_STEP or not _is_extension(key)}
    word = items.get("type")
    if not inner <= _ITEM or not isinstance(word, str) or word not in NUMERIC:
        raise NotPlainError
    size = _size(schema, "minItems", "maxItems")
    rules = [*_limits(items, items=True), *_choice(items, items=True), *([] if size is None else [size])]
    if schema.get("uniqueItems"):
        rules.append(Unique())
    meant, beside = NUMERIC[word]
    tolerated = () if beside is None else (_of_lists(beside),)
    return (_of_lists(meant),), tolerated, tuple(rules)


def _of_lists(kind: RosType) -> RosType:
    return next(item for item in TYPES if item == f"{kind}_array")


def _ros_types(schema: Mapping[str, Any]) -> tuple[RosType, ...]:
    given = schema.get(ROS_TYPE, [])
    words = given if isinstance(given, list) else [given]
    if any(word not in TYPES for word in words):
        raise NotPlainError
    return tuple(words)


def _limits(schema: Mapping[str, Any], *, items: bool = False) -> list[Rule]:
    """Return the range that a schema gives; both kinds of limits at one end are left to the library."""
    given = {key: schema[key] for key in _LIMITS if key in schema}
    if not given:
        return []
    if any(isinstance(value, bool) or not isinstance(value, int | float) for value in given.values()):
        raise NotPlainError
    low, high = given.get("minimum"), given.get("maximum")
    above, below = given.get("exclusiveMinimum"), given.get("exclusiveMaximum")
    if (low is not None and above is not None) or (high is not None and below is not None):
        raise NotPlainError
    return [
        Range(
            above if low is None else low,
            below if high is None else high,
            open_low=above is not None,
            open_high=below is not None,
            step=given.get(ROS_STEP, 0),
            items=items,
        )
    ]


def _choice(schema: Mapping[str, Any], *, items: bool) -> list[Rule]:
    found = []
    for values in ([schema["const"]] if "const" in schema else None, schema.get("enum")):
        if values is None:
            continue
        if not isinstance(values, list) or not all(
            isinstance(one, bool | int | float | str) for one in values
        ):
            raise NotPlainError
        found.append(OneOf(tuple(values), items))
    return [*found]


def _size(schema: Mapping[str, Any], least: str, most: str) -> Size | None:
    low, high = schema.get(least), schema.get(most)
    for bound in (low, high):
        if bound is not None and (isinstance(bound, bool) or not isinstance(bound, int) or bound < 0):
            raise NotPlainError
    return None if low is None and high is None else Size(low, high)


def _is_extension(key: object) -> bool:
    return isinstance(key, str) and key.startswith("x-")
