"""The type support of a service without a compiler, made of those of its request and its response (see `typesupport`).

Service introspection, which would need the event message, is not offered: what only that calls stays null.
"""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, NamedTuple

from rosidl_parser.definition import BoundedSequence, NamespacedType

from orchestra.ros.interfaces import cdr, conversion, description, fields, layouts, typesupport
from orchestra.ros.interfaces.layouts import (
    IndividualType,
    String,
    TypeDescription,
    TypeSource,
    sequence,
    text,
)
from orchestra.ros.interfaces.plain_message import transit_of
from orchestra.ros.interfaces.typesupport import FASTRTPS, INTROSPECTION, Libraries, Message

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.ros.interfaces.layouts import Handle
    from orchestra.ros.interfaces.plain_message import PlainMessage


class Service(NamedTuple):
    """A service `package/srv/name`: the classes of its messages, and its definition as text."""

    package: str
    name: str
    request: type[PlainMessage]
    response: type[PlainMessage]
    source: str

    @property
    def full_name(self) -> str:
        """The name as in the graph."""
        return f"{self.package}/srv/{self.name}"

    @property
    def namespace(self) -> bytes:
        """The namespace of the C names."""
        return f"{self.package}__srv".encode()


class _Nested(NamedTuple):
    """The handles of the compiled types that a service needs, by their names."""

    sending: dict[str, Handle]
    introspection: dict[str, int]


def build(service: Service) -> int:
    """Make the type support of a service, and give its messages theirs; return the address of its handle.

    Raises:
        UnsupportedInstallationError: the libraries are not those of ROS 2 Jazzy.
    """
    with typesupport.jazzy(service.name, service.package):
        libraries = Libraries()
        nested = _nested(service, libraries)
        parts = _parts(service, nested)
        requests = _message(service, service.request, parts, nested, libraries)
        responses = _message(service, service.response, parts, nested, libraries)
        names = (service.namespace.replace(b"__", b"::"), service.name.encode())
        data: dict[bytes, ctypes.Structure] = {
            FASTRTPS: layouts.immortal(layouts.ServiceCallbacks(*names, requests[0], responses[0])),
            INTROSPECTION: layouts.immortal(
                layouts.ServiceMembers(service.namespace, names[1], requests[1], responses[1])
            ),
        }
        functions = typesupport.description_functions(
            _describe(service.full_name, parts), _sources(service, nested)
        )
        null = (0, 0, 0)
        return typesupport.handles(layouts.ServiceHandle, data, functions, requests[0], responses[0], *null)[
            FASTRTPS
        ]


def _message(
    service: Service,
    kind: type[PlainMessage],
    parts: dict[str, IndividualType],
    nested: _Nested,
    libraries: Libraries,
) -> tuple[int, int]:
    """Make the type support of a message; return the addresses of its handle and of its introspection members."""
    transit = transit_of(kind)
    name = kind.__name__.encode()
    members = typesupport.members(
        service.namespace,
        name,
        [fields.introspected(*field, nested.introspection) for field in cdr.fields_of(kind)],
    )
    message = Message(
        service.namespace,
        name,
        _describe(f"{service.package}/srv/{kind.__name__}", parts),
        _sources(service, nested),
        members,
        typesupport.unbounded(next(iter(nested.sending.values()))),
    )
    support = typesupport.message_support(message, transit, libraries)
    type(kind).take(support, transit)  # type: ignore[attr-defined]  # every such class has this metaclass
    return support, ctypes.addressof(members)


def _nested(service: Service, libraries: Libraries) -> _Nested:
    found = _Nested({}, {})
    kinds = [kind for message in (service.request, service.response) for _, kind in cdr.fields_of(message)]
    for kind in kinds:
        item = getattr(kind, "value_type", kind)
        if isinstance(item, NamespacedType):
            _add(found, item, libraries)
    _add(found, _EVENT_INFO, libraries)
    return found


def _add(found: _Nested, name: NamespacedType, libraries: Libraries) -> None:
    metaclass: Any = type(cdr.class_of(name))
    if metaclass._TYPE_SUPPORT is None:  # noqa: SLF001  # the convention of every ROS message
        metaclass.__import_type_support__()
    address = conversion.address_in(metaclass._TYPE_SUPPORT)  # noqa: SLF001  # as above
    sending, introspection = libraries.compiled(address)
    full = "/".join([*name.namespaces, name.name])
    found.sending[full] = sending
    found.introspection[full] = ctypes.addressof(introspection)


_EVENT_INFO = NamespacedType(["service_msgs", "msg"], "ServiceEventInfo")


def _parts(service: Service, nested: _Nested) -> dict[str, IndividualType]:
    """Return the description of the service and of every type it is made of, by their names (REP 2011)."""
    where = [service.package, "srv"]
    request, response, event = (
        NamespacedType(where, f"{service.name}_{part}") for part in ("Request", "Response", "Event")
    )
    own: dict[str, Iterable[tuple[str, Any]]] = {
        service.full_name: [
            ("request_message", request),
            ("response_message", response),
            ("event_message", event),
        ],
        f"{service.full_name}_Request": cdr.fields_of(service.request),
        f"{service.full_name}_Response": cdr.fields_of(service.response),
        f"{service.full_name}_Event": [
            ("info", _EVENT_INFO),
            ("request", BoundedSequence(request, 1)),
            ("response", BoundedSequence(response, 1)),
        ],
    }
    parts = {
        name: IndividualType(
            text(name.encode()),
            sequence(layouts.Field, [fields.described(*field) for field in of_it]),
        )
        for name, of_it in own.items()
    }
    for handle in nested.sending.values():
        found, _ = typesupport.described(handle)
        for part in (found.type_description, *_referenced(found)):
            parts[description.string(part.type_name)] = part
    return parts


def _referenced(found: TypeDescription) -> list[IndividualType]:
    return description.items(found.referenced_type_descriptions, IndividualType)


def _describe(name: str, parts: dict[str, IndividualType]) -> TypeDescription:
    """Describe one of the types, with those that it refers to, directly or not, in the order of their names."""
    needed: set[str] = set()
    todo = [name]
    while todo:
        for field in description.items(parts[todo.pop()].fields, layouts.Field):
            other = description.string(field.type.nested_type_name)
            if other and other not in needed:
                needed.add(other)
                todo.append(other)
    return TypeDescription(parts[name], sequence(IndividualType, [parts[other] for other in sorted(needed)]))


def _sources(service: Service, nested: _Nested) -> String:
    """Return the definition files: that of the service, then those that it needs."""
    own = TypeSource(text(service.full_name.encode()), text(b"srv"), text(service.source.encode()))
    others = {
        description.string(source.type_name): source
        for handle in nested.sending.values()
        for source in description.items(typesupport.described(handle)[1], TypeSource)
    }
    return sequence(TypeSource, [own, *(others[name] for name in sorted(others))])
