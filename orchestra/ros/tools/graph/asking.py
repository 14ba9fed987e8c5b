"""Calling services of nodes, within a time."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, Final

from orchestra.errors import RunError
from orchestra.nearest import nearest
from orchestra.ros.observer.service import OwnService
from orchestra.ros.tools.graph.names import NO_NODE, NO_SERVICE, absolute, nodes, services, unknown
from orchestra.ros.tools.telling import warn

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from orchestra.ros.tools.graph.seeing import Graph

LOOK: Final = 0.005  # nobody tells when a server is there
_SOON: Final = 1.0  # s within which a server that runs is found


class Deadline:
    """The one time, in seconds, that all questions of a command have together; None for no end."""

    def __init__(self, seconds: float | None) -> None:
        self.seconds = seconds
        self._until = None if seconds is None else time.monotonic() + seconds

    @property
    def left(self) -> float | None:
        """How much of it is left."""
        return None if self._until is None else max(0.0, self._until - time.monotonic())

    def __str__(self) -> str:
        return f"{self.seconds:g} s"


def ask(
    graph: Graph,
    kind: Any,  # noqa: ANN401 - a class of an untyped package
    service: str,
    request: Any,  # noqa: ANN401 - as above
    deadline: Deadline,
    *,
    repeat: bool = True,
    asking: Callable[[], object] = lambda: None,
) -> Any:  # noqa: ANN401 - as above
    """Return the response of a service; `repeat` says that a question does no harm twice, `asking` is told before it.

    The answer to a question that comes before the server has discovered the reader of the answer is lost. On the wire
    that is known before anything is asked (`wire.client`); rclpy does not know it. So what must not be asked twice
    follows, by `asking`, something harmless that the same node answers: readers are discovered in the order in which
    they were made.

    Raises `RunError` where the service is not there, or does not answer, in time.
    """
    client = OwnService(graph.node, kind, service)
    answers: list[Any] = []
    try:
        if not graph.wait(lambda: client.ready, deadline.left, LOOK):
            if graph.whole(lambda: graph.node.count_services(service)):
                raise RunError(f"the service {service} was not reached within {deadline}")
            known = {name for name, _ in services(graph, every=False)}
            raise unknown(NO_SERVICE, service, known - {service})  # which our client has made known
        asking()
        client.ask(request, answers.append, repeat=repeat)

        def answered() -> bool:
            client.look()
            return bool(answers)

        if not graph.wait(answered, deadline.left):
            raise RunError(f"the service {service} did not answer within {deadline}")
    finally:
        client.close()
    if answers[0] is None:
        raise RunError(f"the service {service} has failed")
    return answers[0]


def wait_for_server(
    graph: Graph,
    name: str,
    there: Callable[[], Any],
    known: Callable[[], Iterable[tuple[str, object]]],
    deadline: Deadline,
) -> bool:
    """Wait for the server of a service or an action; return whether it is there in time.

    Who waits without end is told of the one that is probably meant, once all of the graph has been seen without it; who
    has a deadline hears that then.
    """
    if deadline.left is None and not graph.wait(there, _SOON, LOOK) and not graph.found(there):
        near = nearest(name, {other for other, _ in known()} - {name})  # which our client has made known
        if near is not None:
            warn(f"warning: nobody serves {name} so far; did you mean {near}?")
    return graph.wait(there, deadline.left, LOOK)


def node_there(graph: Graph, name: str, deadline: Deadline, *, every: bool = True) -> str:
    """Return the full name of a node that is there, waiting for it: it may be starting. Raises `RunError`.

    Who waits is told of the one that is probably meant as soon as all of the graph has been seen.
    """
    full = absolute(name)

    def seen() -> bool:
        return full in nodes(graph, every=every)

    if graph.found(seen):
        return full
    near = nearest(full, nodes(graph))
    if deadline.left and near is not None:
        warn(f"warning: there is no node {full} so far; did you mean {near}?")
    if not graph.wait(seen, deadline.left):
        raise unknown(NO_NODE, full, nodes(graph))
    return full
