"""What launch files import as `ament_index_python`: where packages are, and what they have registered."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "InvalidResourceNameError": "resources",
    "InvalidResourceTypeNameError": "resources",
    "PackageNotFoundError": "packages",
    "RESOURCE_INDEX_SUBFOLDER": "constants",
    "get_package_prefix": "packages",
    "get_package_share_directory": "packages",
    "get_package_share_path": "packages",
    "get_packages_with_prefixes": "packages",
    "get_resource": "resources",
    "get_resource_types": "resources",
    "get_resources": "resources",
    "get_search_paths": "search_paths",
    "has_resource": "resources",
    "constants": "",
    "packages": "",
    "resources": "",
    "search_paths": "",
}

__all__ = sorted(_NAMES)  # noqa: PLE0605 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)
