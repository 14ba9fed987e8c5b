"""The languages that launch files are written in, and how a description becomes a text in each."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Protocol

from orchestra.convert import values, xml_writer, yaml_writer
from orchestra.convert.build import Builder
from orchestra.convert.tree import Document, Scalar, Style
from orchestra.description.written import escaped

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.convert.comments.kept import Comments
    from orchestra.convert.remarks import Remarks
    from orchestra.description.launch import Description


class Write(Protocol):
    """Writes a description in one language."""

    def __call__(
        self, description: Description, comments: Comments, remarks: Remarks, *, partial: bool
    ) -> str:
        """Return the text of a launch file; what cannot be said is told, and left out."""


def as_yaml(description: Description, comments: Comments, remarks: Remarks, *, partial: bool) -> str:
    """Return a launch file in YAML."""
    return yaml_writer.text_of(_document(description, Builder(values.in_yaml, comments, remarks, partial)))


def as_xml(description: Description, comments: Comments, remarks: Remarks, *, partial: bool) -> str:
    """Return a launch file in XML."""
    return xml_writer.text_of(_document(description, Builder(values.in_xml, comments, remarks, partial)))


def as_python(description: Description, comments: Comments, remarks: Remarks, *, partial: bool) -> str:
    """Return a launch file in Python."""
    module = import_module("orchestra.convert.python.module")
    text: str = module.text_of(description, comments, remarks, partial=partial)
    return text


WRITERS: Mapping[str, Write] = {"python": as_python, "xml": as_xml, "yaml": as_yaml}


def _document(description: Description, builder: Builder) -> Document:
    actions = builder.actions(description.actions)
    reason = description.deprecated
    deprecated = None
    if reason is not None:
        deprecated = Scalar(escaped(reason.constant or ""), Style.TEXT, reason.span)
    return Document(actions, deprecated, builder.comments.header, builder.comments.closing)
