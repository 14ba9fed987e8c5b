"""An element whose attributes know their places."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.etree import ElementTree as ET

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.description.source import Written
    from orchestra.location import Span


class PlacedElement(ET.Element):
    """An element as the standard library has it, with its span and its attributes as written."""

    def __init__(self, tag: str, written: Mapping[str, Written], span: Span) -> None:
        super().__init__(tag, {name: value.text for name, value in written.items()})
        self.written = written
        self.span = span
