"""What kind of declaration a file holds, told by its content alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.patterns import pattern

if TYPE_CHECKING:
    from orchestra.declared.model import RosType

FIXED: Final = pattern(r"_fixed_(?P<size>\d+)$")
TYPES: Final[dict[str, RosType]] = {
    "bool": "bool",
    "int": "integer",
    "double": "double",
    "string": "string",
    "bool_array": "bool_array",
    "int_array": "integer_array",
    "double_array": "double_array",
    "string_array": "string_array",
}
NONE: Final = "none"


def is_schema(data: Any) -> bool:  # noqa: ANN401 - whatever a file holds
    """Return whether data is a schema of an object: it says so, or it has properties."""
    if not isinstance(data, dict):
        return False
    if "$schema" in data or data.get("type") == "object":
        return True
    return isinstance(data.get("properties"), dict) and not is_definition(data)


def is_definition(data: Any) -> bool:  # noqa: ANN401 - whatever a file holds
    """Return whether data can be nothing else than a definition: one root, and below it parameters with known types."""
    if not isinstance(data, dict) or len(data) != 1:
        return False
    ((_, root),) = data.items()
    types = list(_types_in(root))
    return bool(types) and None not in types and all(is_type(item) for item in types)


def _types_in(tree: Any) -> list[Any]:  # noqa: ANN401 - as above
    """Return the types of all leaves, None for what is no leaf and no level."""
    if not isinstance(tree, dict) or not tree:
        return [None]
    if is_leaf(tree):
        return [tree["type"]]
    return [item for inner in tree.values() for item in _types_in(inner)]


def is_leaf(tree: dict[Any, Any]) -> bool:
    """Return whether a level of a definition is a parameter."""
    return "type" in tree and not isinstance(tree["type"], dict)


def is_type(word: Any) -> bool:  # noqa: ANN401 - as above
    """Return whether a word is a type of generate_parameter_library."""
    return isinstance(word, str) and (FIXED.sub("", word) in TYPES or word == NONE)
