"""Trees of launch files as entities, for the code of third parties."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch_xml.element import PlacedElement
from orchestra.compat.launch_xml.entity import Entity as XmlEntity
from orchestra.compat.launch_yaml.entity import Entity as YamlEntity
from orchestra.description.source import Keyed

if TYPE_CHECKING:
    from orchestra.compat.launch.frontend.entity import Entity
    from orchestra.location import Span


def entity_of(name: str, content: Any, at: Span) -> Entity:  # noqa: ANN401 - a tree
    """Return the entity of an action: an element, or what stands behind a key."""
    if isinstance(content, PlacedElement):
        return XmlEntity(content)
    item = Keyed(at, at)
    item.put(name, content, at)
    return YamlEntity(item)
