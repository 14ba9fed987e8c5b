"""`launch.frontend.type_utils`: the types that attributes are read as."""

from __future__ import annotations

from types import MappingProxyType
from typing import Any, Final, List  # noqa: UP035 - users' own annotations have it

from orchestra.compat.launch.frontend.entity import is_list_of_entities

_TYPES: Final = MappingProxyType({
    "bool": bool,
    "float": float,
    "int": int,
    "list_of_bool": List[bool],  # noqa: UP006 - compared with users' own annotations
    "list_of_float": List[float],  # noqa: UP006
    "list_of_int": List[int],  # noqa: UP006
    "list_of_str": List[str],  # noqa: UP006
    "str": str,
    "yaml": None,
})  # fmt: skip


def get_data_type_from_identifier(type_identifier: str) -> Any:
    """Return the type that a `type` attribute names, None for `yaml`. Raises `ValueError` for an unknown one."""
    if type_identifier not in _TYPES:
        raise ValueError(f"'{type_identifier}' is no type, only: {', '.join(_TYPES)}")
    return _TYPES[type_identifier]


def check_is_list_entity(data_type: Any) -> bool:
    """Return whether a type is a list of entities."""
    return is_list_of_entities(data_type)
