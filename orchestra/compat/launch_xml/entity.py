"""`launch_xml.Entity`: an element."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.frontend.entity import Entity as BaseEntity
from orchestra.compat.launch.frontend.entity import key_of
from orchestra.compat.launch.utilities.type_utils import get_typed_value
from orchestra.compat.launch_xml.element import PlacedElement

if TYPE_CHECKING:
    from collections.abc import Iterator
    from xml.etree import ElementTree as ET

    from orchestra.description.source import Written
    from orchestra.location import Span

_SEPARATOR = "_sep"


class Entity(BaseEntity):
    """An element: its attributes, a list with `NAME-sep` beside it; its nested elements."""

    def __init__(self, xml_element: ET.Element, *, parent: Entity | None = None) -> None:
        self.__element = xml_element
        self.__parent = parent
        self.__read: set[str] = set()
        self.__read_tags: set[str] = set()

    @property
    def type_name(self) -> str:
        """The tag."""
        return self.__element.tag

    @property
    def parent(self) -> Entity | None:
        """The element around this one."""
        return self.__parent

    @property
    def children(self) -> list[BaseEntity]:
        """All nested elements."""
        self.__read_tags.update(child.tag for child in self.__element)
        return [Entity(child, parent=self) for child in self.__element]

    def _entities(self, name: str) -> list[BaseEntity] | None:
        spelled = name.replace("-", "_")
        found = [child for child in self.__element if child.tag.replace("-", "_") == spelled]
        self.__read_tags.update(child.tag for child in found)
        return [Entity(child, parent=self) for child in found] or None

    def _raw(self, name: str) -> Any:
        key = key_of(name, self.__element.attrib)
        if key is None:
            return None
        self.__read.add(key)
        separator = key_of(name + _SEPARATOR, self.__element.attrib)
        if separator is not None:
            self.__read.add(separator)
            return self.__element.attrib[key].split(self.__element.attrib[separator])
        return self.__written.get(key, self.__element.attrib[key])

    def _coerced(self, raw: Any, data_type: Any, *, can_be_str: bool) -> Any:
        if isinstance(raw, list):  # the texts between separators
            return get_typed_value(raw, data_type, can_be_str=can_be_str)
        return super()._coerced(raw, data_type, can_be_str=can_be_str)

    def _unread(self) -> Iterator[str]:
        yield from dict.fromkeys(child.tag for child in self.__element if child.tag not in self.__read_tags)
        yield from (name for name in self.__element.attrib if name not in self.__read)

    def _texts(self) -> Iterator[Written]:
        yield from self.__written.values()
        for child in self.__element:
            yield from Entity(child)._texts()

    @property
    def __written(self) -> dict[str, Written]:
        return dict(self.__element.written) if isinstance(self.__element, PlacedElement) else {}

    @property
    def _span(self) -> Span | None:
        return self.__element.span if isinstance(self.__element, PlacedElement) else None
