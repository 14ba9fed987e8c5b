"""`launch.LaunchDescriptionEntity`: whatever a launch description is made of."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from orchestra.compat.refusing import Refusing

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.description.entity import Action as Model


class LaunchDescriptionEntity(Refusing):
    """Something that is visited. `_role` tells those apart that a search for declared arguments meets."""

    _role: Literal["other", "declaration", "include", "reset"] = "other"

    def _plain_model(self) -> Model | None:
        """Return the model as long as it is made of arguments as they were given; None where it takes a look."""
        return None

    def describe(self) -> str:
        """Return what the entity is, for people."""
        return self.__repr__()

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return the children that are known without a visit."""
        return []

    def describe_conditional_sub_entities(self) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return children that only a condition brings in, with what the condition says."""
        return []

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:  # noqa: ARG002 - for subclasses
        """Return what is to be visited next, in order."""
        return None

    def get_asyncio_future(self) -> Any:
        """Return what the launch waits for, None here: plans wait for processes, not for futures."""
        return None
