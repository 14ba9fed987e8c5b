"""Visits entities of Python launch files, in upstream's order: depth-first, what an entity returns right after it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from pydantic import ValidationError

from orchestra.compat.building import model_of
from orchestra.compat.launch.action import Action, ModelledAction
from orchestra.compat.launch.launch_description import LaunchDescription
from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
from orchestra.errors import Code
from orchestra.location import displayed, point
from orchestra.resolve.python.calling import user_code
from orchestra.resolve.python.deferral import Deferred, put_off

if TYPE_CHECKING:
    from orchestra.description.actions.opaque import OpaqueAction
    from orchestra.location import Span
    from orchestra.resolve.resolution import Resolution


def visit_entities(entities: Iterable[Any], run: Resolution) -> None:
    """Visit entities in order. An iterable that grows meanwhile is followed to its end, as upstream."""
    for entity in entities:
        visit_entity(entity, run)


def visit_entity(entity: Any, run: Resolution) -> None:
    """Visit an entity, by its model where it has one."""
    if not isinstance(entity, LaunchDescriptionEntity):
        message = f"a launch description is made of actions and other entities, this is {entity!r}"
        run.problems.error(Code.WRONG_TYPE, message, run.at(_span(entity, run)))
        return
    try:
        model = model_of(entity)
    except ValidationError as error:
        _refuse(entity, error, run)
        return
    run.visit((model,), run)


def visit_opaque(action: OpaqueAction, run: Resolution) -> None:
    """Visit an entity that only its own code can carry out; its condition, where it has one, holds."""
    entity = action.target
    if isinstance(entity, ModelledAction) and entity._is_as_described():  # its model is faulty
        visit_entity(entity, run)
        return
    if type(entity).visit is LaunchDescription.visit:
        visit_entities(entity.entities, run)
        return
    if run.later:
        put_off(Deferred("entity", entity), run.at(action.span), run)
        return
    following: Any = None
    context = run.engine.context
    with user_code(run, action.span):
        judged = isinstance(entity, Action) and type(entity).visit is Action.visit
        following = entity.execute(context) if judged else entity.visit(context)
        if following is not None and not isinstance(following, Iterable):
            raise TypeError(f"{_name(entity)} returns a list of entities or None, not {following!r}")
    if following is not None:
        visit_entities(following, run)


def _refuse(entity: Any, error: ValidationError, run: Resolution) -> None:
    """Report values that an action of Python cannot have."""
    for detail in error.errors(include_url=False):
        place = ".".join(str(step) for step in detail["loc"])
        at = run.at(_span(entity, run))
        run.problems.error(Code.WRONG_TYPE, f"{_name(entity)}: {place}: {detail['msg']}", at)


def _name(entity: Any) -> str:
    function = getattr(entity, "function", None)
    return f"{getattr(function, '__qualname__', '') or type(entity).__name__}"


def _span(entity: Any, run: Resolution) -> Span:
    place = getattr(entity, "_place", None)
    span: Span = place.span if place is not None else point(displayed(run.context.file or ""))
    return span
