"""A glance at a launch file in XML."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.etree import ElementTree as ET

from orchestra.cli.glance.model import Glance, SeenArgument, SeenInclude
from orchestra.cli.glance.texts import constant_text

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.cli.glance.model import Places


def glance(text: str, places: Places) -> Glance:
    """Return what the text shows. Raises `ValueError`."""
    try:
        root = ET.fromstring(text)  # noqa: S314 - expat limits entities that grow (its release 2.4.1)
    except ET.ParseError as error:
        raise ValueError(str(error)) from error
    found = list(_actions(root, places, conditional=False))
    return Glance(
        tuple(item for item in found if isinstance(item, SeenArgument)),
        tuple(item for item in found if isinstance(item, SeenInclude)),
    )


def _actions(
    parent: ET.Element, places: Places, *, conditional: bool
) -> Iterator[SeenArgument | SeenInclude]:
    for action in parent:
        within = conditional or "if" in action.attrib or "unless" in action.attrib
        if action.tag == "arg" and "name" in action.attrib:
            yield _argument(action, conditional=within)
        elif action.tag == "include":
            path = constant_text(action.get("file", ""), places)
            if path:
                given = frozenset(child.get("name", "") for child in action if child.tag in ("arg", "let"))
                yield SeenInclude(path, given, within)
        else:
            yield from _actions(action, places, conditional=within)


def _argument(action: ET.Element, *, conditional: bool) -> SeenArgument:
    default = action.get("default")
    choices = tuple(child.get("value", "") for child in action if child.tag == "choice")
    constant = default is not None and "$(" not in default
    return SeenArgument(
        action.attrib["name"], default, constant, choices, action.get("description"), conditional
    )
