"""The visit of an entity and of all that follows from it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity


def visit_all_entities_and_collect_futures(
    entity: LaunchDescriptionEntity, context: LaunchContext
) -> list[tuple[LaunchDescriptionEntity, Any]]:
    """Visit an entity and what each visit returns, depth-first; return those that have a future, with it.

    No entity of Orchestra's own has one; users' may.
    """
    inside = entity.visit(context)
    future = entity.get_asyncio_future()
    found: list[tuple[LaunchDescriptionEntity, Any]] = [] if future is None else [(entity, future)]
    for item in inside or ():
        found += visit_all_entities_and_collect_futures(item, context)
    return found
