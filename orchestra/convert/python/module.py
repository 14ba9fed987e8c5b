"""A launch file in Python: imports, and the function that says what there is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.convert.python.actions import Writer
from orchestra.convert.python.code import INDENT, Element, call, comments, lines, string
from orchestra.convert.python.imports import import_lines
from orchestra.convert.python.parts import Parts
from orchestra.convert.python.texts import Texts

if TYPE_CHECKING:
    from orchestra.convert.comments.kept import Comments
    from orchestra.convert.remarks import Remarks
    from orchestra.description.launch import Description


def text_of(description: Description, found: Comments, remarks: Remarks, *, partial: bool) -> str:
    """Return the text of a launch file; what cannot be said is told, and left out."""
    texts = Texts()
    actions = Writer(Parts(texts, found), remarks, partial).actions(description.actions)
    elements = [Element(actions)]
    if description.deprecated is not None:
        elements.append(Element(string(description.deprecated.constant or ""), "deprecated_reason="))
    made = call(texts.name("LaunchDescription"), elements)
    header = [*comments(found.header, ""), *([""] if found.header else [])]
    written = [
        *header,
        *import_lines(texts.used),
        *["", "", "def generate_launch_description():"],
        *lines(made, INDENT, "return "),
        *comments(found.closing, INDENT),
    ]
    return "\n".join([*written, ""])
