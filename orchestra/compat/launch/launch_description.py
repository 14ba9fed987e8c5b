"""`launch.LaunchDescription`: what a launch file says."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from orchestra.compat.explanation import told
from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
from orchestra.compat.place import IN_CONSTRUCTOR, here
from orchestra.compat.refusing import collector
from orchestra.compat.wrong import WrongType

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext


class LaunchDescription(LaunchDescriptionEntity):
    """Entities in the order in which they are visited. The list is live: what is added during a visit is visited."""

    def __init__(
        self,
        initial_entities: Iterable[LaunchDescriptionEntity] | None = None,
        *,
        deprecated_reason: str | None = None,
    ) -> None:
        is_list = isinstance(initial_entities, Iterable) and not isinstance(initial_entities, str | Mapping)
        if initial_entities is not None and not is_list:
            told_so = f"a list of actions is expected here, this is {told(initial_entities)}"
            raise WrongType(told_so, path=("initial_entities",))
        self.__entities = list(initial_entities) if initial_entities is not None else []
        self.__deprecated_reason = deprecated_reason
        self._place = here(self, IN_CONSTRUCTOR)
        self._lacks_entities = initial_entities is None

    @property
    def entities(self) -> list[LaunchDescriptionEntity]:
        """The list itself."""
        return self.__entities

    @property
    def deprecated(self) -> bool:
        """Whether the file is not to be used any more."""
        return self.__deprecated_reason is not None

    @property
    def deprecated_reason(self) -> str | None:
        """Why the file is not to be used any more."""
        return self.__deprecated_reason

    def add_action(self, action: LaunchDescriptionEntity) -> None:
        """Append an action."""
        self._append(action)

    def add_entity(self, entity: LaunchDescriptionEntity) -> None:
        """Append an entity."""
        self._append(entity)

    def _append(self, entity: LaunchDescriptionEntity) -> None:
        """Append an entity; what is none is reported where it is added, so that the visit has not to do so."""
        if not isinstance(entity, LaunchDescriptionEntity) and collector() is not None:
            from orchestra.compat.misplaced import refuse_entity  # noqa: PLC0415 - only mistakes need it

            refuse_entity(entity, here())
            if isinstance(entity, list | tuple):  # what is in it is not to be missed as well
                self.__entities.extend(item for item in entity if isinstance(item, LaunchDescriptionEntity))
            return
        self.__entities.append(entity)

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:  # noqa: ARG002 - for subclasses
        """Return the entities."""
        return self.__entities

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the entities."""
        return self.__entities

    def get_launch_arguments(self, conditional_inclusion: bool = False) -> list[Any]:
        """Return the arguments that are declared here or in included files, as far as that is known without a visit."""
        found = self.get_launch_arguments_with_include_launch_description_actions(conditional_inclusion)
        return [argument for argument, _ in found]

    def get_launch_arguments_with_include_launch_description_actions(
        self, conditional_inclusion: bool = False
    ) -> list[tuple[Any, list[Any] | None]]:
        """Return the same, each with the includes on the way to it, None where there are none."""
        found: dict[str, tuple[Any, list[Any] | None]] = {}
        _collect(self.__entities, (), found, conditional=conditional_inclusion)
        return list(found.values())


def _collect(
    entities: Iterable[LaunchDescriptionEntity],
    includes: tuple[Any, ...],
    found: dict[str, tuple[Any, list[Any] | None]],
    *,
    conditional: bool,
) -> None:
    """Find declarations depth-first, the first of each name, up to where all configurations are reset."""
    for entity in entities:
        role = entity._role
        if role == "reset":
            return
        if role == "declaration":
            argument: Any = entity
            argument._conditionally_included = conditional or argument.condition is not None
            found.setdefault(argument.name, (argument, list(includes) or None))
            continue
        way = (*includes, entity) if role == "include" else includes
        _collect(entity.describe_sub_entities(), way, found, conditional=conditional)
        for _, inside in entity.describe_conditional_sub_entities():
            _collect(inside, way, found, conditional=True)
