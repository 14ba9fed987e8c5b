"""`service list`, `service type`, `service info`, `service call`, `service find`."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING, Any, Final

from orchestra.errors import RunError
from orchestra.ros.tools.graph.asking import Deadline, ask, wait_for_server
from orchestra.ros.tools.graph.names import NO_SERVICE, absolute, services, unknown
from orchestra.ros.tools.graph.seeing import looking
from orchestra.ros.tools.telling import as_json, json_line, lines, tell

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.ros.tools.graph.seeing import Graph

_NANOSECONDS: Final = 10**9


def list_services(options: Namespace) -> int:
    """Write the names of the services."""
    with looking(options) as graph:
        found = _theirs(graph, every=options.include_hidden_services)
    if options.count_services:
        tell(options, f"{len(found)}\n", len(found))
        return 0
    shown = (f"{name} [{', '.join(types)}]" if options.show_types else name for name, types in found)
    tell(options, lines(shown), [{"name": name, "types": types} for name, types in found])
    return 0


def service_type(options: Namespace) -> int:
    """Write the type of a service."""
    name = absolute(options.service)
    with looking(options) as graph:
        types = _types_of(graph, name)
    tell(options, lines(types), types)
    return 0


def info(options: Namespace) -> int:
    """Write the type of a service, and how many clients and servers it has."""
    name = absolute(options.service)
    with looking(options) as graph:
        node = graph.node
        clients, servers = graph.whole(lambda: (node.count_clients(name), node.count_services(name)))
        types = _types_of(graph, name)
    text = f"Type: {types[0] if len(types) == 1 else types}\nClients count: {clients}\nServices count: {servers}\n"
    tell(options, text, {"name": name, "types": types, "clients": clients, "servers": servers})
    return 0


def find(options: Namespace) -> int:
    """Write the services of a type."""
    with looking(options) as graph:
        seen = _theirs(graph, every=options.include_hidden_services)
    found = [name for name, types in seen if options.type in types]
    if options.count_services:
        tell(options, f"{len(found)}\n", len(found))
    else:
        tell(options, lines(found), found)
    return 0


def call(options: Namespace) -> int:
    """Call a service, and write what it answers."""
    # All of messages, and of rclpy for its clock; only this needs it.
    from orchestra.ros.tools.graph.joining import joined  # noqa: PLC0415
    from orchestra.ros.tools.messages.plain import plain  # noqa: PLC0415
    from orchestra.ros.tools.messages.reading import fill_from  # noqa: PLC0415
    from orchestra.ros.tools.messages.types import service_class  # noqa: PLC0415

    name = absolute(options.service)
    kind = service_class(options.type)
    request = kind.Request()
    timed = fill_from(sys.stdin.read() if options.stdin else options.values, request)
    with (joined if options.use_sim_time else looking)(options) as graph:
        while True:
            began = time.monotonic()
            for owner, field, _ in timed:
                setattr(owner, field, _now(graph, options))
            response = _called(graph, options, kind, name, request)
            _say(options, f"response:\n{response!r}\n\n")
            if as_json(options):
                sys.stdout.write(json_line(plain(response)))
                sys.stdout.flush()
            if options.rate is None:
                return 0
            graph.wait(lambda: False, began + 1 / options.rate - time.monotonic())


def _now(graph: Graph, options: Namespace) -> Any:  # noqa: ANN401 - of an untyped package
    """Return the time as a message."""
    if options.use_sim_time:
        return graph.node.get_clock().now().to_msg()
    from builtin_interfaces.msg import Time  # noqa: PLC0415 - few requests have a time

    seconds, nanoseconds = divmod(time.time_ns(), _NANOSECONDS)
    return Time(sec=seconds, nanosec=nanoseconds)


def _called(graph: Graph, options: Namespace, kind: Any, name: str, request: Any) -> Any:  # noqa: ANN401 - untyped package
    deadline = Deadline(options.timeout)
    if not graph.node.count_services(name):
        _say(options, "waiting for service to become available...\n")
        wait_for_server(
            graph,
            name,
            lambda: graph.node.count_services(name),
            lambda: services(graph, every=False),
            deadline,
        )
    types = dict(services(graph)).get(name, [])
    package, _, own = options.type.rpartition("/")
    if types and f"{package.removesuffix('/srv')}/srv/{own}" not in types:
        raise RunError(f"{name} is of type {', '.join(types)}, not {options.type}")
    return ask(
        graph,
        kind,
        name,
        request,
        deadline,
        repeat=False,
        asking=lambda: _say(options, f"requester: making request: {request!r}\n\n"),
    )


def _say(options: Namespace, text: str) -> None:
    if not as_json(options):
        sys.stdout.write(text)
        sys.stdout.flush()


def _types_of(graph: Graph, name: str) -> list[str]:
    types = graph.found(lambda: dict(services(graph)).get(name))
    if not types:
        raise unknown(NO_SERVICE, name, (known for known, _ in services(graph, every=False)))
    return types


def _theirs(graph: Graph, *, every: bool) -> list[tuple[str, list[str]]]:
    """Return the services without those of our own node."""
    own = f"/{graph.node.get_name()}/"
    return [
        (name, types)
        for name, types in graph.whole(lambda: services(graph, every=every))
        if not name.startswith(own)
    ]
