"""Ready when something is in the ROS graph: the observer looks for it, on request."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.probes.protocol import Request

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.plan.conditions import ParameterFact, StateFact, TransformFact
    from orchestra.probes.protocol import Cancel, Site


class GraphProbe:
    """A fact of the ROS graph. `request` is what the observer is asked."""

    looks_into_graph = True

    def __init__(self, words: str, request: Request) -> None:
        self.words = words
        self.request = request
        self._asking: Cancel | None = None

    def begin(self, site: Site, came: Callable[[], None]) -> None:
        """Ask."""

        def answered(problem: str | None) -> None:
            if problem is None:
                came()
            else:
                site.impossible(problem)

        self._asking = site.watch(self.request, answered)

    def end(self) -> None:
        """Take the request back."""
        if self._asking:
            self._asking.cancel()
            self._asking = None


def node(name: str) -> GraphProbe:
    """Return the condition that a node is there."""
    return GraphProbe(f"the node {name}", Request("node", {"name": name}))


def topic(name: str) -> GraphProbe:
    """Return the condition that somebody publishes on a topic."""
    return GraphProbe(f"a publisher on {name}", Request("topic", {"name": name}))


def message(name: str) -> GraphProbe:
    """Return the condition that a first message has come on a topic."""
    return GraphProbe(f"a message on {name}", Request("message", {"topic": name}))


def service(name: str) -> GraphProbe:
    """Return the condition that somebody offers a service."""
    return GraphProbe(f"the service {name}", Request("service", {"name": name}))


def action(name: str) -> GraphProbe:
    """Return the condition that somebody offers an action."""
    return GraphProbe(f"the action {name}", Request("action", {"name": name}))


def parameter(fact: ParameterFact) -> GraphProbe:
    """Return the condition that a node has declared a parameter, and that it has a value, where one is given."""
    about = {"node": fact.node, "name": fact.name}
    if fact.value is None:
        return GraphProbe(f"the parameter {fact.name} of {fact.node}", Request("parameter", {**about}))
    words = f"the value {fact.value!r} of the parameter {fact.name} of {fact.node}"
    return GraphProbe(words, Request("parameter", {**about, "value": fact.value}))


def lifecycle(fact: StateFact) -> GraphProbe:
    """Return the condition that a lifecycle node is in a state."""
    about: Request = Request("lifecycle", {"node": fact.node, "state": fact.state})
    return GraphProbe(f"the state {fact.state} of {fact.node}", about)


def transform(fact: TransformFact) -> GraphProbe:
    """Return the condition that one frame can be transformed into another."""
    request = Request("tf", {"parent": fact.parent, "child": fact.child})
    return GraphProbe(f"the transform from {fact.parent} to {fact.child}", request)
