"""Whether the definitions of a package are right: each by itself, and the types that they name."""

from __future__ import annotations

from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from rosidl_parser.definition import AbstractNestedType, Message, NamespacedType, Service

from orchestra.nearest import nearest
from orchestra.ros.interfaces.reading import interface
from orchestra.ros.interfaces.reading.mistakes import DefinitionError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from orchestra.resolve.interfaces.sources import Source
    from orchestra.ros.interfaces.reading.interface import Interface

Types = Any  # the types of a package by their names, None for a package that is not here
_SUFFIXES: Final = (".msg", ".idl")


def mistakes(source: Source, types_of: Callable[[str], frozenset[str] | None]) -> list[DefinitionError]:
    """Return what is wrong; `types_of` gives the messages of another package, None for one that is not here."""
    found: list[DefinitionError] = []
    read: dict[Path, Interface] = {}
    for path in source.files:
        try:
            read[path] = interface.read(source.name, source.folder / path, shown(source.folder / path))
        except DefinitionError as error:
            found.append(error)
    own = frozenset(path.stem for path in source.files if path.parts[0] == "msg")
    for content in read.values():
        found.extend(_unknown(source, content, own, types_of))
    return found or _circles(source, read)


def shown(path: Path) -> str:
    """Return a path as it is told to people: relative to the working directory if it is below that."""
    here = Path.cwd()
    return str(path.relative_to(here)) if path.is_relative_to(here) else str(path)


def needed(source: Source) -> frozenset[str]:
    """Return the packages whose types the definitions use, and those that services and actions bring with them."""
    kinds = {path.parts[0] for path in source.files}
    found = {
        name.namespaces[0]
        for path in source.files
        for _, _, name in _named(interface.read(source.name, source.folder / path))
    }
    if kinds & {"srv", "action"}:
        found |= {"service_msgs", "builtin_interfaces"}
    if "action" in kinds:
        found |= {"action_msgs", "unique_identifier_msgs"}
    return frozenset(found - {source.name})


def _named(content: Interface) -> Iterator[tuple[str, str, NamespacedType]]:
    """Yield message, field and type of each field that holds messages."""
    for message in _messages(content.content):
        for member in message.structure.members:
            item = member.type.value_type if isinstance(member.type, AbstractNestedType) else member.type
            if isinstance(item, NamespacedType):
                yield message.structure.namespaced_type.name, member.name, item


def _messages(content: Any) -> list[Any]:  # noqa: ANN401 - a class of rosidl_parser
    if isinstance(content, Message):
        return [content]
    if isinstance(content, Service):
        return [content.request_message, content.response_message]
    return [content.goal, content.result, content.feedback]


def _unknown(
    source: Source,
    content: Interface,
    own: frozenset[str],
    types_of: Callable[[str], frozenset[str] | None],
) -> Iterator[DefinitionError]:
    for message, field, name in _named(content):
        package = name.namespaces[0]
        known = own if package == source.name else types_of(package)
        if known is not None and name.name in known:
            continue
        place = content.types.get((message, field))
        if known is None:
            told = f"there is no package '{package}' with messages here"
        else:
            near = nearest(name.name, sorted(known))
            hint = f"; did you mean '{near}'?" if near else ""
            told = f"package {package} has no message '{name.name}'{hint}"
        yield DefinitionError(told, content.file, place)


def _circles(source: Source, read: Mapping[Path, Interface]) -> list[DefinitionError]:
    """Return the messages that hold themselves, which no message can."""
    edges = {
        path.stem: {name.name for _, _, name in _named(content) if name.namespaces[0] == source.name}
        for path, content in read.items()
        if path.parts[0] == "msg"
    }
    try:
        TopologicalSorter(edges).prepare()
    except CycleError as error:
        circle = _from_the_first(list(reversed(error.args[1][1:])))
        path, content = next(
            item for item in read.items() if item[0].parts[0] == "msg" and item[0].stem == circle[0]
        )
        field = next(field for _, field, name in _named(content) if name.name == circle[1])
        told = f"a message cannot hold itself: {' holds '.join(circle)}"
        return [DefinitionError(told, content.file, content.types.get((path.stem, field)))]
    return []


def _from_the_first(names: list[str]) -> list[str]:
    """Return a circle as it begins at its first name in the order of letters, and ends."""
    begin = names.index(min(names))
    return [*names[begin:], *names[:begin], names[begin]]


def messages_in(share: Path) -> frozenset[str] | None:
    """Return the messages that are installed in a share folder, None where there are none."""
    folder = share / "msg"
    found = frozenset(path.stem for path in folder.glob("*") if path.suffix in _SUFFIXES)
    return found or None
