"""Files that end in `.launch`, which may be XML or YAML: the first character that is not blank tells."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.load import xml_file, yaml_file

if TYPE_CHECKING:
    from orchestra.load.reader import Reader


def read(text: str, file: str, reader: Reader) -> Any | None:  # noqa: ANN401 - a tree
    """Return the tree of a text in either language, None where it is neither (which has been reported)."""
    language = xml_file if text.lstrip().startswith("<") else yaml_file
    return language.read(text, file, reader)
