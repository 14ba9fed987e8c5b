"""`launch.Action`: an entity with a condition that does something when it is visited."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
from orchestra.compat.place import IN_CONSTRUCTOR, here

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from orchestra.compat.launch.condition import Condition
    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.description.entity import Action as Model


class Action(LaunchDescriptionEntity):
    """The base of all actions, and the one that users derive from: they write `execute(context)`.

    It takes one keyword, `condition`; any other is a `TypeError`, as upstream.
    """

    def __init__(self, *, condition: Condition | None = None) -> None:
        self.__condition = condition
        self._place = here(self, IN_CONSTRUCTOR)

    @classmethod
    def parse(
        cls, entity: Any, parser: Any, ignore: Iterable[str] | None = None
    ) -> tuple[type[Any], dict[str, Any]]:
        """Return the class and the keywords with which an entity of a launch file in XML or YAML constructs it.

        Attributes in `ignore` are left for the caller. Raises what reading them raises.
        """
        read = import_module("orchestra.compat.launch.frontend.reading")  # which few launch files need
        return cls, read.keywords(cls, entity, parser, ignore or ())

    @property
    def condition(self) -> Condition | None:
        """When the action is carried out, None: always."""
        return self.__condition

    def describe(self) -> str:
        """Return what the action is."""
        return self.__repr__()

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the children that are known without a visit; a subclass says which."""
        return []

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the children that are there whatever happens."""
        return self.get_sub_entities() if self.condition is None else []

    def describe_conditional_sub_entities(self) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the children that are there if the condition is true."""
        if self.condition is None:
            return []
        return [("Conditionally included by " + self.describe(), self.get_sub_entities())]

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Execute the action if its condition says so; return what is to be visited next."""
        if self.condition is not None and not self.condition.evaluate(context):
            return None
        try:
            return self.execute(context)
        finally:
            context._engine.completed(self)

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:  # noqa: ARG002 - for subclasses
        """Do what the action does; return what is to be visited next. Here: nothing."""
        return None


class ModelledAction(Action):
    """An action that the launch language knows: it turns into a model.

    A model is made at each visit, from what the object holds then.
    """

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Carry the model out."""
        context._engine.carry_out(self._to_model({"origin": self}))
        return None

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        """Return the model; `common` are the fields that every action has (condition, origin)."""
        raise NotImplementedError

    def _is_as_described(self) -> bool:
        """Return whether nobody has changed what a visit does, so that the model says it all."""
        kind = type(self)
        execute: Any = kind.execute
        return kind.visit is Action.visit and (execute in _OURS or _is_ours(execute))


# What actions of ours do at a visit, as far as it has been looked at.
_OURS: Final[set[Any]] = set()


def _is_ours(execute: Any) -> bool:
    if execute.__module__.startswith("orchestra.compat."):
        _OURS.add(execute)
        return True
    return False
