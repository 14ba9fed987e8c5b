"""A definition file as a whole: one message, the two of a service or the three of an action."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, NamedTuple

from rosidl_adapter import parser as adapter  # type: ignore[import-untyped]  # as every ROS package
from rosidl_parser import definition

from orchestra.ros.interfaces.reading import lines
from orchestra.ros.interfaces.reading.lines import Part
from orchestra.ros.interfaces.reading.mistakes import DefinitionError, Place

if TYPE_CHECKING:
    from pathlib import Path

Content = Any  # a message, service or action of rosidl_parser, which has no type information

_SEPARATOR: Final = "---"
_PARTS: Final = {"msg": ("",), "srv": ("_Request", "_Response"), "action": ("_Goal", "_Result", "_Feedback")}
_WHOLE: Final = {"srv": definition.Service, "action": definition.Action}
_BETWEEN: Final = {
    "srv": "between the request and the response of a service there is one line '---'",
    "action": "between goal, result and feedback of an action there are two lines '---'",
}


class Interface(NamedTuple):
    """What a definition says. `types` has the place of each type that a field names, by message and field."""

    content: Content
    source: str
    kind: str
    file: str
    types: dict[tuple[str, str], Place]


def read(package: str, path: Path, file: str | None = None) -> Interface:
    """Read the definition in a file; messages call it `file`.

    Raises:
        DefinitionError: what is written there is no definition, or it cannot be read.
    """
    shown = file or str(path)
    try:
        source = path.read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise DefinitionError(f"it cannot be read: {error}", shown) from error
    if path.suffix == ".idl":
        # Only now: it brings a parser of grammars, which takes longer to import than all the rest.
        from orchestra.ros.interfaces.reading import idl  # noqa: PLC0415

        return Interface(idl.content(source, package, path.parent.name, shown), source, "idl", shown, {})
    return _of(package, path.suffix[1:], path.stem, source, shown)


def _of(package: str, kind: str, name: str, source: str, file: str) -> Interface:
    if not adapter.is_valid_message_name(name) or "_" in name:
        raise DefinitionError(
            f"'{name}' is not the name of a type: letters and digits, a capital first", file
        )
    namespaces = [package, kind]
    read_parts = [lines.read(part, namespaces, file) for part in _parts(kind, name, source, file)]
    types = {
        (part.message.structure.namespaced_type.name, field): place
        for part in read_parts
        for field, place in part.types.items()
    }
    messages = [part.message for part in read_parts]
    if kind == "msg":
        return Interface(messages[0], source, kind, file, types)
    whole = _WHOLE[kind](definition.NamespacedType(namespaces, name), *messages)
    return Interface(whole, source, kind, file, types)


def _parts(kind: str, name: str, source: str, file: str) -> list[Part]:
    text = source.splitlines()
    cuts = [number for number, line in enumerate(text) if line == _SEPARATOR] if kind != "msg" else []
    endings = _PARTS[kind]
    if len(cuts) != len(endings) - 1:
        odd = cuts[len(endings) - 1] if len(cuts) >= len(endings) else max(len(text) - 1, 0)
        width = len(text[odd]) if text else 0
        raise DefinitionError(_BETWEEN[kind], file, Place(odd + 1, 1, max(width, 1) + 1))
    begins = [0, *(cut + 1 for cut in cuts)]
    ends = [*cuts, len(text)]
    return [
        Part(name + ending, begin + 1, text[begin:end])
        for ending, begin, end in zip(endings, begins, ends, strict=True)
    ]
