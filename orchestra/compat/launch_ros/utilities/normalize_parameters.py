"""Parameters as users write them, in one form.

A dictionary becomes flat, its names tuples of substitutions. Its values are scalars, bytes, `ParameterValue`s, tuples
of scalars, tuples of substitutions (concatenated and read as YAML) or tuples of such tuples (a list of values). What is
normalised already stays as it is.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from orchestra.compat.described import described
from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution
from orchestra.compat.launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue
from orchestra.compat.launch_ros.utilities.exact import Exact, builtin
from orchestra.compat.text import normalized
from orchestra.compat.wrong import WrongType

_SCALARS = (bool, int, float, str)
_PAIR = 2


def normalize_parameters(parameters: Any) -> tuple[Any, ...]:
    """Return `ParameterFile`, `Parameter` and flat dictionaries. Raises `TypeError` for anything but a list."""
    if isinstance(parameters, str) or not isinstance(parameters, Sequence):
        raise TypeError(f"parameters are a list of dictionaries and files, not {parameters!r}")
    return tuple(_one(item) for item in parameters)


def normalize_parameter_dict(parameters: Any, *, _prefix: Sequence[Substitution] = ()) -> dict[Any, Any]:
    """Return a flat dictionary; names of levels are joined with dots. Raises `TypeError` for other values."""
    if not isinstance(parameters, Mapping):
        raise TypeError(f"expected a dictionary of parameters, found {parameters!r}")
    found: dict[Any, Any] = {}
    for key, value in parameters.items():
        name = (*_prefix, *normalized(key))
        if isinstance(value, Mapping):
            if key == "ros__parameters":
                from orchestra.compat.sections import tell_section  # noqa: PLC0415 - only mistakes need it

                tell_section()
            found.update(normalize_parameter_dict(value, _prefix=(*name, *normalized("."))))
        else:
            found[name] = _named_value(name, value)
    return found


normalize_parameters_dict = normalize_parameter_dict


def _one(item: Any) -> Any:
    if isinstance(item, Mapping):
        return normalize_parameter_dict(item)
    if isinstance(item, Parameter | ParameterFile):
        return item
    if isinstance(item, list | tuple) and any(isinstance(part, Mapping) for part in item):
        raise WrongType("parameters are dictionaries and files, this is a list in the list", item)
    if isinstance(item, tuple) and len(item) == _PAIR and isinstance(item[0], str) and _is_value(item[1]):
        raise WrongType(
            "parameters are dictionaries and files, this is a pair: a dictionary has a colon", item
        )
    if isinstance(item, set) and len(item) > 1:
        raise WrongType(
            "parameters are dictionaries and files, this is a set: a dictionary has a colon", item
        )
    if not isinstance(item, str | Substitution | os.PathLike | bytes | Iterable):
        raise TypeError(f"parameters are dictionaries and files, not {item!r}")
    return ParameterFile(item)


def _is_value(value: Any) -> bool:
    """Return whether a value is none that a path can be made of."""
    return isinstance(value, bool | int | float | list)


def _named_value(name: Sequence[Substitution], value: Any) -> Any:
    try:
        return _value(value)
    except TypeError as error:
        raise TypeError(f"parameter {_shown(name)}: {error}") from None


def _shown(name: Sequence[Substitution]) -> str:
    """Return a name as a launch file has it where it is a text, else what it is made of."""
    if all(isinstance(part, TextSubstitution) for part in name):
        return repr("".join(part.text for part in name if isinstance(part, TextSubstitution)))
    return described(name)


def _value(value: Any) -> Any:
    if isinstance(value, str):
        return (Exact(builtin(value)),)
    if isinstance(value, Substitution):
        return (value,)
    if isinstance(value, bool | int | float):
        return builtin(value)
    if isinstance(value, bytes | ParameterValue):
        return value
    if isinstance(value, Sequence):
        return _list(value)
    raise TypeError(f"{value!r} is no value of a parameter")


def _list(items: Sequence[Any]) -> tuple[Any, ...]:
    kinds = {_kind(item) for item in items}
    if kinds == {float, int}:
        return tuple(float(item) for item in items)
    if kinds in ({int}, {float}, {bool}, {bool, int}):
        return tuple(builtin(item) for item in items)
    if Substitution in kinds and kinds <= {str, Substitution}:
        return tuple(normalized(items))
    return tuple(_item(item) for item in items)


def _item(item: Any) -> tuple[Substitution, ...]:
    if isinstance(item, _SCALARS):
        return (Exact(builtin(item)),)
    if isinstance(item, list | tuple) and not all(isinstance(part, str | Substitution) for part in item):
        raise WrongType(f"a parameter cannot be a list of lists, as {item!r} in it", item)
    return tuple(normalized(item))


def _kind(item: Any) -> type:
    """Return what an item of a list counts as. Raises `TypeError` for what no list can hold."""
    kinds = (*_SCALARS, Substitution, Sequence)
    found = next((kind for kind in kinds if isinstance(item, kind)), None)
    if found is None or isinstance(item, bytes):
        raise TypeError(f"a parameter that is a list cannot hold {item!r}")
    return found
