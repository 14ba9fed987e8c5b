"""How attributes are read, whatever the action."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, List  # noqa: UP035 - what users' annotations have

from orchestra.compat.launch.conditions import IfCondition, UnlessCondition
from orchestra.compat.launch.frontend.entity import Entity

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch.substitution import Substitution

ENTITIES = List[Entity]  # noqa: UP006 - compared with users' own annotations


def condition(entity: Entity, parser: Any) -> dict[str, Any]:
    """Return the condition of an entity. Raises `RuntimeError` for two of them."""
    holds = entity.get_attr("if", optional=True)
    fails = entity.get_attr("unless", optional=True)
    if holds is not None and fails is not None:
        raise RuntimeError(f"'{entity.type_name}' has one of 'if' and 'unless', not both")
    if holds is not None:
        return {"condition": IfCondition(predicate_expression=parser.parse_substitution(holds))}
    if fails is not None:
        return {"condition": UnlessCondition(predicate_expression=parser.parse_substitution(fails))}
    return {}


def texts(entity: Entity, parser: Any, names: Mapping[str, str], *, optional: bool = False) -> dict[str, Any]:
    """Return texts with substitutions; `names` gives the keyword for each attribute."""
    found = {keyword: entity.get_attr(name, optional=optional) for name, keyword in names.items()}
    return {keyword: parser.parse_substitution(text) for keyword, text in found.items() if text is not None}


def values(entity: Entity, names: Mapping[str, type[Any]]) -> dict[str, Any]:
    """Return values of a type, which are written as they are; keywords are called as their attributes."""
    found = {
        name: entity.get_attr(name, data_type=kind, optional=True, can_be_str=False)
        for name, kind in names.items()
    }
    return {name: value for name, value in found.items() if value is not None}


def value_or_text(entity: Entity, parser: Any, name: str, kind: type[Any]) -> dict[str, Any]:
    """Return a value of a type, or substitutions that come to one."""
    value = entity.get_attr(name, data_type=kind, optional=True)
    return {} if value is None else {name: parser.parse_if_substitutions(value)}


def pairs(
    entity: Entity, parser: Any, name: str, first: str = "name", second: str = "value"
) -> list[tuple[list[Substitution], list[Substitution]]]:
    """Return the pairs of texts in the nested entities of a name."""
    found = []
    for item in entity.get_attr(name, data_type=ENTITIES, optional=True) or ():
        both = (parser.parse_substitution(item.get_attr(word)) for word in (first, second))
        found.append((next(both), next(both)))
        item.assert_entity_completely_parsed()
    return found


def variables(entity: Entity, parser: Any, name: str) -> dict[tuple[Substitution, ...], list[Substitution]]:
    """Return the pairs of a name and a value as a mapping."""
    return {tuple(key): value for key, value in pairs(entity, parser, name)}
