"""Parameters: values, nested ones, and files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.frontend.reading.attributes import ENTITIES
from orchestra.compat.launch.frontend.type_utils import get_data_type_from_identifier
from orchestra.compat.launch_ros.parameter_descriptions import ParameterFile, ParameterValue

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.compat.launch.frontend.entity import Entity


def parameters(params: Iterable[Entity], parser: Any) -> list[Any]:
    """Return each parameter: a file, or a mapping. Raises `RuntimeError` where one is neither or both."""
    return [_parameter(param, parser) for param in params]


def _parameter(param: Entity, parser: Any) -> Any:
    file = param.get_attr("from", optional=True)
    if file is None:
        return dict([_entry(param, parser)])
    if param.get_attr("name", optional=True) is not None:
        raise RuntimeError("a param has either a 'name' or a file ('from')")
    found: dict[str, Any] = {"param_file": parser.parse_substitution(file)}
    evaluated = param.get_attr("allow_substs", data_type=bool, optional=True, can_be_str=False)
    if evaluated is not None:
        found["allow_substs"] = evaluated
    param.assert_entity_completely_parsed()
    return ParameterFile(**found)


def _entry(param: Entity, parser: Any) -> tuple[Any, Any]:
    """Return the name of a parameter, and its value or the mapping of those below it."""
    name = tuple(parser.parse_substitution(param.get_attr("name")))
    identifier = param.get_attr("type", optional=True)
    kind = None if identifier is None else get_data_type_from_identifier(identifier)
    value = param.get_attr("value", data_type=kind, optional=True)
    nested = param.get_attr("param", data_type=ENTITIES, optional=True)
    if (value is None) == (nested is None):
        raise RuntimeError("a param has one of 'value', 'param' and 'from'")
    if identifier is not None and value is None:
        raise RuntimeError("the 'type' of a param goes with its 'value'")
    param.assert_entity_completely_parsed()
    if nested is not None:
        return name, dict(_entry(item, parser) for item in nested)
    return name, ParameterValue(parser.parse_if_substitutions(value), value_type=kind)
