"""Elements for Python code that parses them: as the standard library has them, with their places."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.launch_xml.element import PlacedElement

if TYPE_CHECKING:
    from orchestra.load.elements import Element
    from orchestra.load.offsets import Source


def placed(element: Element, whole: Source) -> PlacedElement:
    """Return an element with all that are nested in it."""
    written = {attribute.name: attribute.written(whole) for attribute in element.attributes}
    found = PlacedElement(element.name, written, element.span(whole))
    found.extend(placed(child, whole) for child in element.children)
    return found
