"""The lines of a definition: fields and constants of a message."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final, NamedTuple, TypeVar

from rosidl_parser import definition

from orchestra.ros.interfaces.reading import words
from orchestra.ros.interfaces.reading.mistakes import DefinitionError, Place

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from orchestra.ros.interfaces.reading.words import Kind

_LINE: Final = re.compile(r"(?P<type>[^ ]*)(?: +(?P<rest>.*))?")

_Result = TypeVar("_Result")


class Part(NamedTuple):
    """Some lines of a file: of a service or an action each part is a message. `first` is the number of the first."""

    name: str
    first: int
    lines: Sequence[str]


class Read(NamedTuple):
    """A message, and where the types of its fields stand."""

    message: definition.Message
    types: dict[str, Place]


class _Line(NamedTuple):
    """A line without its comment, and where it stands."""

    file: str
    number: int
    text: str

    def place(self, begin: int, text: str) -> Place:
        return Place(self.number, begin + 1, begin + 1 + max(len(text), 1))

    def told(self, begin: int, text: str, function: Callable[..., _Result], *arguments: object) -> _Result:
        """Call a function that raises `ValueError` about a text on this line."""
        try:
            return function(*arguments)
        except ValueError as error:
            raise DefinitionError(str(error), self.file, self.place(begin, text)) from error


def read(part: Part, namespaces: Sequence[str], file: str) -> Read:
    """Return the message that some lines define. Raises `DefinitionError`."""
    names = definition.NamespacedType(list(namespaces), part.name)
    found = Read(definition.Message(definition.Structure(names)), {})
    for number, text in enumerate(part.lines, part.first):
        content = text.replace("\t", " ").partition("#")[0].rstrip()
        if content:
            _add(found, _Line(file, number, content), namespaces[0])
    if not found.message.structure.members:
        name = definition.EMPTY_STRUCTURE_REQUIRED_MEMBER_NAME
        found.message.structure.members.append(definition.Member(definition.BasicType("uint8"), name))
    return found


def _add(found: Read, line: _Line, package: str) -> None:
    """Add the field or constant of a line."""
    parts = _LINE.fullmatch(line.text)
    if parts is None or not parts["type"]:
        indented = line.text.lstrip()
        place = Place(line.number, 1, len(line.text) - len(indented) + 1)
        raise DefinitionError("a line begins with its type, without space before it", line.file, place)
    if not parts["rest"]:
        what = "a line has a type and a name"
        raise DefinitionError(what, line.file, line.place(0, line.text))
    begin = parts.start("rest")
    if "=" in parts["rest"]:
        _add_constant(found.message, line, parts["type"], begin)
    else:
        _add_field(found, line, parts["type"], begin, package)


def _add_field(found: Read, line: _Line, text: str, begin: int, package: str) -> None:
    type_ = line.told(0, text, words.type_of, text, package)
    name, _, value = line.text[begin:].partition(" ")
    line.told(begin, name, words.check_field_name, name)
    if name in found.types:
        at = line.place(begin, name)
        raise DefinitionError(f"there is a field '{name}' already", line.file, at)
    member = definition.Member(words.kind_of(type_), name)
    if value := value.lstrip():
        at_value = len(line.text) - len(value)
        known = line.told(at_value, value, words.default, type_, value)
        member.annotations.append(definition.Annotation("default", {"value": known}))
    found.message.structure.members.append(member)
    found.types[name] = line.place(0, text)


def _add_constant(message: definition.Message, line: _Line, text: str, begin: int) -> None:
    if not words.is_basic(text):
        at = line.place(0, text)
        raise DefinitionError(f"a constant has a primitive type, not '{text}'", line.file, at)
    name, _, value = line.text[begin:].partition("=")
    name = name.rstrip()
    line.told(begin, name, words.check_constant_name, name)
    if any(name == known.name for known in message.constants):
        at = line.place(begin, name)
        raise DefinitionError(f"there is a constant '{name}' already", line.file, at)
    value = value.lstrip()
    known = line.told(len(line.text) - len(value), value, words.constant, text, value)
    kind: Kind = words.constant_kind(text, known)
    message.constants.append(definition.Constant(name, kind, known))
