"""`service echo`: the requests and responses of a service of which a client or the server tells."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING, Any, Final

from rclpy.qos import qos_profile_services_default
from service_msgs.msg import ServiceEventInfo

from orchestra.errors import RunError
from orchestra.ros.tools.echo import renderer
from orchestra.ros.tools.graph.hearing import subscribe
from orchestra.ros.tools.graph.joining import joined
from orchestra.ros.tools.graph.names import NO_SERVICE, absolute, services, unknown
from orchestra.ros.tools.messages.types import service_class
from orchestra.ros.tools.telling import warn

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.ros.tools.graph.joining import Graph

_TOPIC: Final = "/_service_event"
_KINDS: Final = {
    getattr(ServiceEventInfo, name): name
    for name in ("REQUEST_SENT", "REQUEST_RECEIVED", "RESPONSE_SENT", "RESPONSE_RECEIVED")
}


def echo(options: Namespace) -> int:
    """Write the events of a service as they come."""
    name = absolute(options.service)
    wanted = 1 if options.once else options.count
    shown = 0
    render = renderer(options, _worded)

    def heard(message: Any, about: dict[str, Any]) -> None:  # noqa: ANN401 - of any class
        nonlocal shown
        if wanted is None or shown < wanted:
            shown += 1
            sys.stdout.write(render(message, about))
            sys.stdout.flush()

    until = None if options.timeout is None else time.monotonic() + options.timeout
    with joined(options) as graph:
        kind = service_class(options.type or _type_of(graph, name)).Event
        subscribe(graph.node, kind, f"{name}{_TOPIC}", qos_profile_services_default, heard)
        if not graph.whole(lambda: graph.node.count_publishers(f"{name}{_TOPIC}")):
            warn(f"nobody tells of {name} yet: a client or the server has to have service introspection on")
        left = None if until is None else max(0.0, until - time.monotonic())
        enough = graph.wait(lambda: wanted is not None and shown >= wanted, left)
    if wanted is not None and not enough:
        raise RunError(f"{name}: {shown} of {wanted} events came within {options.timeout:g} s")
    return 0


def _worded(event: dict[str, Any]) -> dict[str, Any]:
    """Return an event with the name of what has happened in place of its number, as the ROS 2 tools write it."""
    kind = event["info"]["event_type"]
    return {**event, "info": {**event["info"], "event_type": _KINDS.get(kind, kind)}}


def _type_of(graph: Graph, name: str) -> str:
    types = graph.found(lambda: dict(services(graph)).get(name))
    if not types:
        raise unknown(NO_SERVICE, name, (known for known, _ in services(graph, every=False)))
    return types[0]
