"""Readiness and signs of life, with full names: as the process itself would name things, through its remaps.

Names of nodes are not remapped by rcl, only put in the namespace.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from orchestra.errors import Code
from orchestra.plan.conditions import Alive, ParameterFact, Ready, StateFact, TransformFact
from orchestra.plan.ids import node_name
from orchestra.resolve.awaited import OWN
from orchestra.resolve.names import (
    Fault,
    InvalidName,
    expanded,
    full_topic_name_fault,
    mended,
    rmw_namespace_fault,
    rmw_node_name_fault,
    topic_name_fault,
)
from orchestra.resolve.refusals import refuse_value
from orchestra.resolve.remaps import read_rule, remapped

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.errors import Problems
    from orchestra.resolve.awaited import ResolvedParameterFact, ResolvedStateFact
    from orchestra.resolve.context import Value
    from orchestra.resolve.model import ResolvedProcess

_DEFAULT_READY = Ready(None, None, None)
_DEFAULT_ALIVE = Alive()


def readiness(process: ResolvedProcess, problems: Problems) -> Ready | None:
    """Return when a process is ready. Names that cannot be are reported."""
    ready = process.ready
    if ready is None:
        return None
    names = _Names(process, problems)
    return Ready(
        log=ready.log,
        message=names.topic(ready.message),
        timeout=ready.timeout,
        tcp=ready.tcp,
        http=ready.http,
        file=ready.file,
        command=ready.command,
        notify=ready.notify,
        node=names.node(ready.node),
        topic=names.topic(ready.topic),
        service=names.service(ready.service),
        action=names.action(ready.action),
        parameter=names.parameter(ready.parameter),
        lifecycle=names.state(ready.lifecycle),
        tf=None if ready.tf is None else TransformFact(ready.tf.parent, ready.tf.child),
        interval=_or(ready.interval, _DEFAULT_READY.interval),
    )


def life(process: ResolvedProcess, problems: Problems) -> Alive | None:
    """Return the signs of life that a process gives. A rate that its window cannot tell is reported."""
    alive = process.alive
    if alive is None:
        return None
    window = _or(alive.window, _DEFAULT_ALIVE.window)
    if alive.min_rate is not None and alive.min_rate * window < 1:
        problems.error(
            Code.BAD_VALUE,
            f"in {window:g} s there is less than one message at {alive.min_rate:g} a second",
            alive.location,
            notes=(f"give it a `window` of {1 / alive.min_rate:g} seconds or more",),
        )
    return Alive(
        notify=alive.notify,
        message=_Names(process, problems).topic(alive.message),
        min_rate=alive.min_rate,
        window=window,
        command=alive.command,
        interval=_or(alive.interval, _DEFAULT_ALIVE.interval),
        timeout=_or(alive.timeout, _DEFAULT_ALIVE.timeout),
        failures=_DEFAULT_ALIVE.failures if alive.failures is None else alive.failures,
        abort=alive.abort,
    )


class _Names:
    """What names stand for in a process."""

    def __init__(self, process: ResolvedProcess, problems: Problems) -> None:
        self._own = node_name(process)
        self._namespace = process.namespace.text if process.namespace is not None else "/"
        self._name = process.name.text if process.name is not None else "_"
        self._rules = [read_rule(rule.source.text, rule.target.text) for rule in process.remaps]
        self._is_node = process.kind != "process"
        self._problems = problems

    def topic(self, written: Value | None) -> str | None:
        """Return the full name of a topic."""
        return self._named(written, "a topic", lambda name: self._remapped(name, "topic"))

    def service(self, written: Value | None) -> str | None:
        """Return the full name of a service."""
        return self._named(written, "a service", lambda name: self._remapped(name, "service"))

    def action(self, written: Value | None) -> str | None:
        """Return the full name of an action: what is remapped are the services that it is made of."""
        return self._named(written, "an action", self._action)

    def node(self, written: Value | None) -> str | None:
        """Return the full name of a node."""
        return self._named(written, "a node", self._node)

    def parameter(self, fact: ResolvedParameterFact | None) -> ParameterFact | None:
        """Return a parameter of a node with its full name."""
        return None if fact is None else ParameterFact(self.node(fact.node) or "", fact.name, fact.value)

    def state(self, fact: ResolvedStateFact | None) -> StateFact | None:
        """Return the state of a node with its full name."""
        return None if fact is None else StateFact(self.node(fact.node) or "", fact.state)

    def _named(self, written: Value | None, what: str, full: Callable[[str], str]) -> str | None:
        if written is None:
            return None
        try:
            return full(written.text)
        except InvalidName as error:
            message = f"'{written.text}' cannot be {what}: {error.fault.reason}"
            if written.text == OWN:
                message = error.fault.reason
            meant = mended(written.text, topic_name_fault)
            refuse_value(written, self._problems, Code.BAD_NAME, message, meant=meant)
            return None

    def _remapped(self, name: str, kind: Literal["topic", "service"]) -> str:
        whole = remapped(name, self._rules, self._namespace, self._name, kind)
        return _accepted(whole, full_topic_name_fault(whole))

    def _action(self, name: str) -> str:
        goals = "/_action/send_goal"
        return self._remapped(f"{name}{goals}", "service").removesuffix(goals)

    def _node(self, name: str) -> str:
        if name == OWN:
            return self._own_name()
        whole = expanded(name, self._namespace, self._name)
        namespace, _, last = whole.rpartition("/")
        return _accepted(whole, rmw_namespace_fault(namespace or "/") or rmw_node_name_fault(last))

    def _own_name(self) -> str:
        if self._own is not None:
            return self._own
        if self._is_node:
            raise InvalidName(OWN, Fault("the name of its own node is not known: give it a `name`", 0))
        raise InvalidName(OWN, Fault("a program has no node of its own that is known: name the node", 0))


def _accepted(name: str, fault: Fault | None) -> str:
    if fault is not None:
        raise InvalidName(name, fault)
    return name


def _or(value: float | None, default: float) -> float:
    return default if value is None else value
