"""What packages have registered: a file per resource in `PREFIX/share/ament_index/resource_index/TYPE/NAME`."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from orchestra.compat.ament_index_python.constants import RESOURCE_INDEX_SUBFOLDER
from orchestra.compat.ament_index_python.search_paths import searched


class InvalidResourceTypeNameError(ValueError):
    """No type of resources can have this name."""


class InvalidResourceNameError(ValueError):
    """No resource can have this name."""


def get_resource(resource_type: str, resource_name: str) -> tuple[str, str]:
    """Return the content of a resource and the prefix that has it, the first one that does.

    Raises `LookupError` where none has it, `OSError` where it cannot be read, `InvalidResourceTypeNameError` and
    `InvalidResourceNameError` for names with a slash.
    """
    prefix = has_resource(resource_type, resource_name)
    if not prefix:
        raise LookupError(f"there is no resource {resource_name!r} of the type {resource_type!r}")
    return (_folder(prefix, resource_type) / resource_name).read_text("utf-8"), prefix


def get_resources(resource_type: str) -> dict[str, str]:
    """Return the prefix of each resource of a type by its name. Raises `InvalidResourceTypeNameError`."""
    _check_type(resource_type)
    found: dict[str, str] = {}
    for prefix in searched():
        for entry in _entries(_folder(prefix, resource_type)):
            if not entry.is_dir():
                found.setdefault(entry.name, prefix)
    return found


def get_resource_types() -> set[str]:
    """Return the names of all types of resources."""
    return {
        entry.name
        for prefix in searched()
        for entry in _entries(Path(prefix, RESOURCE_INDEX_SUBFOLDER))
        if entry.is_dir()
    }


def has_resource(resource_type: str, resource_name: str) -> str | Literal[False]:
    """Return the prefix that has a resource, False where none does. Raises as `get_resource` for wrong names."""
    _check_type(resource_type)
    if not resource_name or "/" in resource_name or "\\" in resource_name:
        raise InvalidResourceNameError(f"{resource_name!r} cannot be the name of a resource")
    return next(
        (prefix for prefix in searched() if (_folder(prefix, resource_type) / resource_name).is_file()), False
    )


def _check_type(resource_type: str) -> None:
    if not resource_type or "/" in resource_type or "\\" in resource_type:
        raise InvalidResourceTypeNameError(f"{resource_type!r} cannot be the name of a type of resources")


def _folder(prefix: str, resource_type: str) -> Path:
    return Path(prefix, RESOURCE_INDEX_SUBFOLDER, resource_type)


def _entries(folder: Path) -> list[Path]:
    if not folder.is_dir():
        return []
    return [entry for entry in folder.iterdir() if not entry.name.startswith(".")]
