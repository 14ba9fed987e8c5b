"""What launch files import as `launch.utilities`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "AsyncSafeSignalManager": "signal_management",
    "create_future": "create_future_impl",
    "ensure_argument_type": "ensure_argument_type_impl",
    "is_a": "class_tools_impl",
    "is_a_subclass": "class_tools_impl",
    "isclassinstance": "class_tools_impl",
    "normalize_to_list_of_entities": "normalize_to_list_of_entities_impl",
    "normalize_to_list_of_substitutions": "normalize_to_list_of_substitutions_impl",
    "perform_substitutions": "perform_substitutions_impl",
    "type_utils": "",
    "typing_file_path": "",
    "visit_all_entities_and_collect_futures": "visit_all_entities_and_collect_futures_impl",
}

__all__ = sorted(_NAMES)  # noqa: PLE0605 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)
