"""Entities of Python launch files as models, as deep as they go: what only code can carry out stays opaque."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.building import models_of
from orchestra.compat.launch.events.shutdown import Shutdown as ShutdownEvent
from orchestra.compat.launch.launch_description import LaunchDescription
from orchestra.description.actions.emit_event import EmitEvent
from orchestra.description.actions.group import Group
from orchestra.description.actions.opaque import OpaqueAction
from orchestra.description.actions.register_event_handler import RegisterEventHandler
from orchestra.description.actions.shutdown import Shutdown
from orchestra.description.running import Running
from orchestra.description.text import Template, Words

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from orchestra.convert.remarks import Remarks
    from orchestra.description.entity import Action


def unfolded(actions: Iterable[Action], remarks: Remarks) -> tuple[Action, ...]:
    """Return the actions with what is known of the objects among them."""
    return tuple(found for action in actions for found in _unfolded(action, remarks))


def _unfolded(action: Action, remarks: Remarks) -> Iterator[Action]:
    if isinstance(action, OpaqueAction):
        target = action.target
        if isinstance(target, LaunchDescription) and type(target).visit is LaunchDescription.visit:
            yield from unfolded(models_of(target.entities, target._place), remarks)  # noqa: SLF001 - a class of ours
            return
        yield action
    elif isinstance(action, EmitEvent) and type(action.event) is ShutdownEvent:
        yield Shutdown.at(action.span, origin=action.origin, if_=action.if_, unless=action.unless)
    elif isinstance(action, Group) and _has_handlers_of_its_own(action):
        yield _without_handlers(action, remarks)
    elif hasattr(action, "children") and isinstance(action.children, tuple):
        yield action.model_copy(update={"children": unfolded(action.children, remarks)})
    else:
        yield action


def _has_handlers_of_its_own(group: Group) -> bool:
    """Return whether a group is only there because a process has handlers for its own events."""
    match group.children:
        case (RegisterEventHandler(origin=None), Running()):
            return group.origin is None
    return False


def _without_handlers(group: Group, remarks: Remarks) -> Action:
    """Return the process alone: without what is only kept for code, and with the end of the run as a word."""
    registering, process = group.children
    assert isinstance(registering, RegisterEventHandler)  # noqa: S101 - the caller has asked
    update: dict[str, Any] = {"if_": group.if_, "unless": group.unless}
    handlers = [item for item in registering.handlers if not getattr(item.origin, "_serves_code", False)]
    required = process.required if isinstance(process, Running) else None
    if handlers and required is not None:
        word = Template((Words("shutdown", process.span),), "shutdown", process.span)
        update |= {"required": None, "on_exit": word}
        remarks.warn("the reason of the shutdown is left out: `on_exit: shutdown` has none", process.span)
    elif handlers:
        remarks.lose("`on_exit` does more than end the run: no key says that", process.span)
    return process.model_copy(update=update)
