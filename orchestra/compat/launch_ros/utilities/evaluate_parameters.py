"""Parameters as values and paths, for user code that asks for them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch.utilities.type_utils import coerce_to_type
from orchestra.compat.launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue
from orchestra.compat.launch_ros.utilities.exact import Exact

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.launch_context import LaunchContext

_SCALARS = (bool, int, float, str)


def evaluate_parameters(context: LaunchContext, parameters: Any) -> tuple[Any, ...]:
    """Return a path for each file, a dictionary for each dictionary, and each `Parameter`, which is evaluated then.

    The parameters are those of `normalize_parameters`. Raises `TypeError` where a value cannot be a parameter.
    """
    found: list[Any] = []
    for item in parameters:
        if isinstance(item, ParameterFile):
            found.append(item.evaluate(context))
        elif isinstance(item, Parameter):
            item.evaluate(context)
            found.append(item)
        elif isinstance(item, Mapping):
            found.append(evaluate_parameter_dict(context, item))
    return tuple(found)


def evaluate_parameter_dict(context: LaunchContext, parameters: Any) -> dict[str, Any]:
    """Return the values by name. Raises `TypeError` where one cannot be a parameter."""
    if not isinstance(parameters, Mapping):
        raise TypeError(f"expected a dictionary of parameters, found {parameters!r}")
    found: dict[str, Any] = {}
    for name, value in parameters.items():
        if not isinstance(name, tuple):
            raise TypeError(f"the name of a parameter is a tuple of substitutions, not {name!r}")
        found[_performed(context, name)] = _value(context, value)
    return found


evaluate_parameters_dict = evaluate_parameter_dict


def _value(context: LaunchContext, value: Any) -> Any:
    if isinstance(value, ParameterValue):
        return value.evaluate(context)
    if not isinstance(value, tuple):
        return value
    if not value or not isinstance(value[0], Substitution | tuple):
        return _uniform(value)
    if isinstance(value[0], Substitution):
        return _read(context, value)
    return _uniform(tuple(_read(context, item) for item in value))


def _read(context: LaunchContext, substitutions: Sequence[Substitution]) -> Any:
    """Return what substitutions come to, read as YAML."""
    only = substitutions[0] if len(substitutions) == 1 else None
    if isinstance(only, Exact):
        return only.value
    text = _performed(context, substitutions)
    if not text:
        return text
    try:
        value: Any = coerce_to_type(text)
    except ValueError as error:
        raise TypeError(f"Allowed value types are scalars and lists of them: {error}") from error
    return _uniform(tuple(value)) if isinstance(value, list) else value


def _uniform(items: tuple[Any, ...]) -> tuple[Any, ...]:
    kinds = {type(item) for item in items}
    if len(kinds) != 1 and kinds != {bool, int}:
        raise TypeError(f"Expected a non-empty sequence of one type, found {items!r}")
    if not kinds & set(_SCALARS):
        raise TypeError(f"Expected a non-empty sequence of scalars, found {items!r}")
    return items


def _performed(context: LaunchContext, substitutions: Sequence[Substitution]) -> str:
    return "".join(context.perform_substitution(item) for item in substitutions)
