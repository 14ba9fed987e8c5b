"""`launch_yaml.Parser`: launch files in YAML."""

from __future__ import annotations

from orchestra.compat.launch.frontend.parser import Parser as BaseParser
from orchestra.compat.launch_yaml.entity import Entity
from orchestra.compat.seam import connection


class Parser(BaseParser):
    """Reads YAML, whatever the name of the file."""

    @classmethod
    def load_text(cls, text: str, name: str) -> tuple[Entity, BaseParser]:
        """Return the root of a text. Raises `InvalidFrontendLaunchFileError`."""
        return Entity(connection().front_end.tree(text, name, "yaml")), cls()

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Return what the names of files in YAML end in."""
        return {"launch.yaml", "launch.yml", "yaml", "yml", "launch"}

    @classmethod
    def _language(cls, name: str, text: str) -> type[BaseParser]:  # noqa: ARG003 - it is this one
        return cls
