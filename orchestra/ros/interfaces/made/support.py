"""The type support of a message, a service or an action, made of those of the types that it consists of.

See `typesupport` for how messages get through the middleware.
"""

from __future__ import annotations

import ctypes
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

from rosidl_parser.definition import AbstractNestedType, NamespacedType

from orchestra.ros.interfaces import conversion, description, fields, layouts, typesupport
from orchestra.ros.interfaces.layouts import (
    IndividualType,
    String,
    TypeDescription,
    TypeSource,
    sequence,
    text,
)
from orchestra.ros.interfaces.made import events
from orchestra.ros.interfaces.made.transit import transit_of
from orchestra.ros.interfaces.slots import class_of
from orchestra.ros.interfaces.typesupport import FASTRTPS, INTROSPECTION, Libraries, Message

if TYPE_CHECKING:
    from collections.abc import Sequence

Class = Any  # a class of a message, service or action, untyped

_IMPLICIT = "implicit"


# The class of the objects that stand for the messages of a class on their way.
_TRANSITS: dict[Class, type[conversion.MessageInTransit]] = {}


class Origin(NamedTuple):
    """The definition that a type comes from: its kind (`msg`, `srv`, `action`, `idl`), and its text.

    A type that a service or action brings with it has none of its own.
    """

    encoding: str = _IMPLICIT
    source: str = ""


class Own(NamedTuple):
    """What a type is called and consists of: the name, type and default value, as text, of each of its parts."""

    name: NamespacedType
    parts: Sequence[tuple[str, Any, str]]
    origin: Origin

    @property
    def full_name(self) -> str:
        """The name as in the graph."""
        return fields.full_name(self.name)

    @property
    def c_namespace(self) -> bytes:
        """The namespace of the C names."""
        return "__".join(self.name.namespaces).encode()


@cache
def libraries() -> Libraries:
    """Return the libraries behind type supports, once they are known to be those of ROS 2 Jazzy."""
    return Libraries()


def support_in(kind: Class) -> int:
    """Return the address of the type support of a class, which is made or loaded if it was not yet."""
    metaclass = type(kind)
    if metaclass._TYPE_SUPPORT is None:  # noqa: SLF001  # the convention of every ROS type
        metaclass.__import_type_support__()
    return conversion.address_in(metaclass._TYPE_SUPPORT)  # noqa: SLF001  # as above


def give_message(kind: Class, own: Own) -> None:
    """Make the type support of a message class, and give it to its metaclass.

    Raises:
        UnsupportedInstallationError: the libraries are not those of ROS 2 Jazzy.
    """
    package = own.name.namespaces[0]
    with typesupport.jazzy(own.name.name, package):
        nested = _nested(own)
        introspection = {
            name: ctypes.addressof(libraries().compiled(address)[1]) for name, address in nested.items()
        }
        members = typesupport.members(
            own.c_namespace,
            own.name.name.encode(),
            [fields.introspected(name, type_, introspection) for name, type_, _ in own.parts],
        )
        of_type, sources = _described(own, [libraries().compiled(address)[0] for address in nested.values()])
        message = Message(
            own.c_namespace, own.name.name.encode(), of_type, sources, members, _without_bounds()
        )
        transit = transit_of(kind)
        _TRANSITS[kind] = transit
        support = typesupport.message_support(message, transit, libraries())
    metaclass = type(kind)
    for name, function in conversion.capsules(transit).items():
        setattr(metaclass, name, function)
    metaclass._TYPE_SUPPORT = conversion.capsule(support)  # noqa: SLF001  # as above


def give_service(kind: Class, own: Own) -> None:
    """Make the type support of a service class, and give it to its metaclass. Raises as `give_message`."""
    with typesupport.jazzy(own.name.name, own.name.namespaces[0]):
        messages = [support_in(part) for part in (kind.Request, kind.Response, kind.Event)]
        pairs = [libraries().compiled(address) for address in messages]
        sending = [ctypes.addressof(pair[0]) for pair in pairs]
        members = [pair[1].data for pair in pairs]
        names = (own.c_namespace.replace(b"__", b"::"), own.name.name.encode())
        data: dict[bytes, ctypes.Structure] = {
            FASTRTPS: layouts.immortal(layouts.ServiceCallbacks(*names, *sending[:2])),
            INTROSPECTION: layouts.immortal(layouts.ServiceMembers(own.c_namespace, names[1], *members)),
        }
        functions = typesupport.description_functions(*_described(own, [pair[0] for pair in pairs]))
        table = typesupport.handles(
            layouts.ServiceHandle, data, functions, *sending, *events.functions(kind, _TRANSITS[kind.Event])
        )
    type(kind)._TYPE_SUPPORT = conversion.capsule(table[FASTRTPS])  # noqa: SLF001  # as above


def give_action(kind: Class, own: Own) -> None:
    """Make the type support of an action class, and give it to its metaclass. Raises as `give_message`."""
    implementation = kind.Impl
    services = [implementation.SendGoalService, implementation.GetResultService]
    others = [implementation.CancelGoalService]
    messages = [implementation.FeedbackMessage]
    with typesupport.jazzy(own.name.name, own.name.namespaces[0]):
        parts = [kind.Goal, kind.Result, kind.Feedback, *messages]
        handles = [libraries().compiled(support_in(part))[0] for part in parts]
        addresses = [support_in(part) for part in (*services, *others, *messages)]
        addresses.append(support_in(implementation.GoalStatusMessage))
        described = [layouts.ServiceHandle.from_address(address) for address in addresses[: len(services)]]
        functions = typesupport.description_functions(*_described(own, [*handles, *described]))
        handle = layouts.immortal(layouts.ActionHandle(*addresses, *functions))
    type(kind)._TYPE_SUPPORT = conversion.capsule(ctypes.addressof(handle))  # noqa: SLF001  # as above


def _nested(own: Own) -> dict[str, int]:
    """Return the addresses of the type supports of the messages that are parts of a message, by their names."""
    found: dict[str, int] = {}
    for _, kind, _ in own.parts:
        item = kind.value_type if isinstance(kind, AbstractNestedType) else kind
        if isinstance(item, NamespacedType):
            found[fields.full_name(item)] = support_in(class_of(item))
    return found


@cache
def _without_bounds() -> int:
    """Return the function of a compiled type without bounds that says so: any that has a string will do."""
    address = support_in(class_of(NamespacedType(["rcl_interfaces", "msg"], "ParameterValue")))
    return typesupport.unbounded(libraries().compiled(address)[0])


def _described(own: Own, handles: Sequence[Any]) -> tuple[TypeDescription, String]:
    """Describe a type, with those that it refers to, directly or not, in the order of their names (REP 2011).

    `handles` are those of its parts, which know the rest.
    """
    described = [layouts.Field.from_buffer_copy(fields.described(*part)) for part in own.parts]
    parts = {own.full_name: IndividualType(text(own.full_name.encode()), sequence(layouts.Field, described))}
    sources: dict[str, TypeSource] = {}
    for handle in handles:
        found, of_it = typesupport.described(handle)
        referenced = description.items(found.referenced_type_descriptions, IndividualType)
        for part in (found.type_description, *referenced):
            parts.setdefault(description.string(part.type_name), part)
        for source in description.items(of_it, TypeSource):
            sources.setdefault(description.string(source.type_name), source)
    needed = sorted(parts.keys() - {own.full_name})
    source = TypeSource(*(text(word.encode()) for word in (own.full_name, *own.origin)))
    return (
        TypeDescription(parts[own.full_name], sequence(IndividualType, [parts[name] for name in needed])),
        sequence(TypeSource, [source, *(sources[name] for name in needed)]),
    )
