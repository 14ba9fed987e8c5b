"""`launch_xml.Parser`: launch files in XML."""

from __future__ import annotations

from orchestra.compat.launch.frontend.parser import Parser as BaseParser
from orchestra.compat.launch_xml.entity import Entity
from orchestra.compat.seam import connection


class Parser(BaseParser):
    """Reads XML, whatever the name of the file."""

    @classmethod
    def load_text(cls, text: str, name: str) -> tuple[Entity, BaseParser]:
        """Return the root of a text. Raises `InvalidFrontendLaunchFileError`."""
        return Entity(connection().front_end.tree(text, name, "xml")), cls()

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Return what the names of files in XML end in."""
        return {"launch.xml", "xml", "launch"}

    @classmethod
    def _language(cls, name: str, text: str) -> type[BaseParser]:  # noqa: ARG003 - it is this one
        return cls
