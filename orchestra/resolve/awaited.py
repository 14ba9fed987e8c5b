"""What processes are waited for with, and the signs of life they give, resolved but for the names.

The plan finds out what the names stand for; `~` is the process's own node. What nobody has said is None: the plan has
the defaults.
"""

from __future__ import annotations

from typing import Final

from orchestra.dataclass import dataclass
from orchestra.location import Location
from orchestra.resolve.context import Value
from orchestra.values import ParameterValue

OWN: Final = "~"


@dataclass(frozen=True, slots=True)
class ResolvedParameterFact:
    """A parameter that a node has declared, with the value where one is given."""

    node: Value
    name: str
    value: ParameterValue | None


@dataclass(frozen=True, slots=True)
class ResolvedStateFact:
    """The state of a lifecycle node."""

    node: Value
    state: str


@dataclass(frozen=True, slots=True)
class ResolvedTransformFact:
    """A transform between two frames."""

    parent: str
    child: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ResolvedReady:
    """When a process counts as ready; `timeout` and `interval` in seconds. Where nothing is to come about it cannot."""

    log: str | None
    tcp: str | None
    http: str | None
    file: str | None
    command: tuple[str, ...] | None
    notify: bool
    message: Value | None
    topic: Value | None
    node: Value | None
    service: Value | None
    action: Value | None
    parameter: ResolvedParameterFact | None
    lifecycle: ResolvedStateFact | None
    tf: ResolvedTransformFact | None
    timeout: float | None
    interval: float | None

    @property
    def empty(self) -> bool:
        """Whether it says nothing that is waited for, as where a substitution has come to false."""
        of_ros = (self.message, self.topic, self.node, self.service, self.action)
        facts = (self.parameter, self.lifecycle, self.tf)
        others = (self.log, self.tcp, self.http, self.file, self.command, self.notify or None)
        return all(item is None for item in (*of_ros, *facts, *others))


@dataclass(frozen=True, slots=True, kw_only=True)
class ResolvedAlive:
    """Signs of life; times in seconds."""

    notify: float | None
    message: Value | None
    min_rate: float | None
    window: float | None
    command: tuple[str, ...] | None
    interval: float | None
    timeout: float | None
    failures: int | None
    abort: bool
    location: Location
