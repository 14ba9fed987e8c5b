"""Actions that carry out others again and again."""

from __future__ import annotations

from copy import deepcopy
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.actions.opaque_function import OpaqueFunction
from orchestra.compat.launch.frontend.reading.attributes import texts
from orchestra.compat.launch.substitutions.for_loop_var import ForEachVar

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from orchestra.compat.launch.action import Action
    from orchestra.compat.launch.frontend.entity import Entity
    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity


def for_each(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return mappings, and a function that has the children for one of them."""
    turn = _turn(entity, parser)
    return {
        **texts(entity, parser, {"values": "input_values"}),
        "function": lambda **values: turn(values),
    }


def for_loop(entity: Entity, parser: Any, _ignored: frozenset[str]) -> dict[str, Any]:
    """Return a number and a name, and a function that has the children for one index."""
    turn = _turn(entity, parser)
    name = entity.get_attr("name")
    return {
        **texts(entity, parser, {"len": "length"}),
        "name": name,
        "function": lambda i: turn({name: i}),
    }


def _turn(entity: Entity, parser: Any) -> Callable[[Mapping[str, Any]], list[LaunchDescriptionEntity]]:
    actions: list[Action] = [parser.parse_action(child) for child in entity.children]

    def turn(values: Mapping[str, Any]) -> list[LaunchDescriptionEntity]:
        found = {ForEachVar.get_local_arg_name(name): str(value) for name, value in values.items()}

        def begin(context: LaunchContext) -> None:
            context._push_locals()
            context.extend_locals(found)

        def end(context: LaunchContext) -> None:
            context._pop_locals()

        return [OpaqueFunction(function=begin), *deepcopy(actions), OpaqueFunction(function=end)]

    return turn
