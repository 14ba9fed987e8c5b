"""The classes that a definition stands for: of a message one, of a service its three messages and itself, and so on."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, NoReturn

from rosidl_parser import definition

from orchestra.ros.interfaces.made import support
from orchestra.ros.interfaces.made.message_class import message_class
from orchestra.ros.interfaces.made.support import Origin, Own
from orchestra.ros.interfaces.slots import class_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from orchestra.ros.interfaces.made.support import Class
    from orchestra.ros.interfaces.reading.interface import Content, Interface

_IMPLICIT = Origin()


def classes_of(interface: Interface, module: str) -> dict[str, Class]:
    """Return the classes of a definition by their names; `module` is where they say they come from."""
    origin = Origin(interface.kind, interface.source)
    content = interface.content
    if isinstance(content, definition.Message):
        return _message(content, module, origin)
    if isinstance(content, definition.Service):
        return _service(content, module, origin)
    return _action(content, module, origin)


def _message(message: Content, module: str, origin: Origin = _IMPLICIT) -> dict[str, Class]:
    name = message.structure.namespaced_type
    own = Own(name, [_part(member) for member in message.structure.members], origin)
    return {name.name: message_class(message, module, partial(support.give_message, own=own))}


def _part(member: Any) -> tuple[str, Any, str]:  # noqa: ANN401 - a class of rosidl_parser
    default = str(member.get_annotation_value("default")["value"]) if member.has_annotation("default") else ""
    return member.name, member.type, default


def _service(service: Content, module: str, origin: Origin = _IMPLICIT) -> dict[str, Class]:
    messages = (service.request_message, service.response_message, service.event_message)
    names = ("request_message", "response_message", "event_message")
    parts = [
        (name, message.structure.namespaced_type, "") for name, message in zip(names, messages, strict=True)
    ]
    found = {name: kind for message in messages for name, kind in _message(message, module).items()}
    request, response, event = found.values()
    own = Own(service.namespaced_type, parts, origin)
    members = {
        "__module__": module,
        "Request": request,
        "Response": response,
        "Event": event,
        "__init__": _not_made("Service"),
    }
    return {**found, own.name.name: _without_messages("service", own, members, support.give_service)}


def _action(action: Content, module: str, origin: Origin) -> dict[str, Class]:
    messages = [action.goal, action.result, action.feedback, action.feedback_message]
    services = [action.send_goal_service, action.get_result_service]
    found: dict[str, Class] = {}
    for message in messages:
        found |= _message(message, module)
    for service in services:
        found |= _service(service, module)
    goal, result, feedback, feedback_message = (
        found[message.structure.namespaced_type.name] for message in messages
    )
    send_goal, get_result = (found[service.namespaced_type.name] for service in services)
    own = Own(action.namespaced_type, _parts_of_action(messages, services), origin)
    implementation = {
        "__module__": module,
        "__qualname__": f"{own.name.name}.Impl",
        "SendGoalService": send_goal,
        "GetResultService": get_result,
        "FeedbackMessage": feedback_message,
        "CancelGoalService": class_of(definition.NamespacedType(["action_msgs", "srv"], "CancelGoal")),
        "GoalStatusMessage": class_of(definition.NamespacedType(["action_msgs", "msg"], "GoalStatusArray")),
    }
    members = {
        "__module__": module,
        "Goal": goal,
        "Result": result,
        "Feedback": feedback,
        "Impl": type("Impl", (), implementation),
        "__init__": _not_made("Action"),
    }
    return {**found, own.name.name: _without_messages("action", own, members, support.give_action)}


def _parts_of_action(messages: Sequence[Content], services: Sequence[Content]) -> list[tuple[str, Any, str]]:
    goal, result, feedback, feedback_message = (message.structure.namespaced_type for message in messages)
    send_goal, get_result = (service.namespaced_type for service in services)
    return [
        ("goal", goal, ""),
        ("result", result, ""),
        ("feedback", feedback, ""),
        ("send_goal_service", send_goal, ""),
        ("get_result_service", get_result, ""),
        ("feedback_message", feedback_message, ""),
    ]


def _without_messages(
    what: str, own: Own, members: dict[str, Any], give: Callable[[Class, Own], None]
) -> Class:
    """Return the class of a service or action, which has no messages of its own but those in it."""
    name = own.name.name
    made: list[Class] = []

    def import_type_support(cls: Class) -> None:
        if cls._TYPE_SUPPORT is None:
            give(made[0], own)

    content = {
        "__doc__": f"Metaclass of {what} '{name}'.",
        "_TYPE_SUPPORT": None,
        "__import_type_support__": classmethod(import_type_support),
    }
    made.append(type(f"Metaclass_{name}", (type,), content)(name, (), members))
    return made[0]


def _not_made(what: str) -> Callable[[object], NoReturn]:
    def __init__(_self: object) -> NoReturn:  # noqa: N807 - the method of a class
        raise NotImplementedError(f"{what} classes can not be instantiated")

    return __init__
