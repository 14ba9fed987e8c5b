"""When a process counts as ready, and the signs of life that it gives."""

from __future__ import annotations

from typing import Annotated, Final

from orchestra.description.conflict import Conflict
from orchestra.description.entity import Entity
from orchestra.description.fields import AnyValue, Argv, Flag, Seconds, Text, word, worded
from orchestra.description.marks import Plain
from orchestra.description.model import field
from orchestra.description.ranges import COUNT, INTERVAL, RATE, SOME_SECONDS
from orchestra.description.short import Short
from orchestra.description.text import Template

# The states of a lifecycle node that last, by their labels (lifecycle_msgs/msg/State).
STATES: Final = ("unconfigured", "inactive", "active", "finalized")

_TRIED: Final = ("tcp", "http", "file", "command")


class ParameterFact(Entity):
    """A parameter that a node has declared."""

    node: Text | None = field(default=None, description="The node; its own where absent.")
    name: Text = field(description="Name of the parameter.")
    value: AnyValue | None = field(default=None, description="The value that it has; any where absent.")


class StateFact(Entity):
    """The state of a lifecycle node."""

    node: Text | None = field(default=None, description="The node; its own where absent.")
    state: Annotated[Template, Plain(word(*STATES)), worded(*STATES)] = field(
        description="The state that it is in."
    )


class TransformFact(Entity):
    """A transform that can be looked up."""

    parent: Text = field(description="Frame that is transformed into.")
    child: Text = field(description="Frame that is transformed from.")


class Ready(Entity):
    """When a process counts as ready: when all that stands here has come about."""

    log: Text | None = field(
        default=None, description="A line of its output matches this regular expression."
    )
    message: Text | None = field(default=None, description="The first message on this topic has come.")
    topic: Text | None = field(default=None, description="This topic has a publisher.")
    node: Text | None = field(default=None, description="This node is there; `true`: its own.")
    service: Text | None = field(default=None, description="This service has a server.")
    action: Text | None = field(default=None, description="This action has a server.")
    parameter: Annotated[ParameterFact, Short("name")] | None = field(
        default=None, description="A node has declared this parameter, and it has the value."
    )
    lifecycle: Annotated[StateFact, Short("state")] | None = field(
        default=None, description="A lifecycle node is in this state."
    )
    tf: TransformFact | None = field(default=None, description="This transform is there.")
    tcp: Text | None = field(default=None, description="This port, or HOST:PORT, accepts a connection.")
    http: Text | None = field(default=None, description="This URL answers with a status from 200 to 399.")
    file: Text | None = field(
        default=None, description="This path exists; relative to its working directory."
    )
    command: Argv | None = field(default=None, description="This command exits with 0.")
    notify: Flag | None = field(default=None, description="It says `READY=1` itself, as to systemd.")
    timeout: Seconds | None = field(default=None, description="After so many seconds the run has failed.")
    interval: Annotated[Template, INTERVAL] | None = field(
        default=None, description="Seconds between two tries of `tcp`, `http`, `file` and `command`."
    )

    def conflict(self) -> Conflict | None:
        """Return what is missing beside what stands here."""
        if all(getattr(self, key) is None for key in FACTS):
            return Conflict(f"`ready` says what is awaited: one or more of {', '.join(FACTS)}")
        if self.interval is not None and all(getattr(self, key) is None for key in _TRIED):
            reason = "`interval` goes with `tcp`, `http`, `file` or `command`: all else is told as it happens"
            return Conflict(reason, ("interval",))
        return None


FACTS: Final = tuple(key for key in Ready.model_fields if key not in ("timeout", "interval"))


class Alive(Entity):
    """Signs of life that a process gives once it is ready; where they stay away it hangs."""

    notify: Annotated[Template, SOME_SECONDS] | None = field(
        default=None, description="It says `WATCHDOG=1` at least every so many seconds, as to systemd."
    )
    message: Text | None = field(default=None, description="Messages come on this topic, at `min_rate`.")
    min_rate: Annotated[Template, RATE] | None = field(
        default=None, description="Least number of messages a second."
    )
    window: Annotated[Template, SOME_SECONDS] | None = field(
        default=None, description="Seconds that the rate is an average of."
    )
    command: Argv | None = field(default=None, description="This command exits with 0 time and again.")
    interval: Annotated[Template, INTERVAL] | None = field(
        default=None, description="Seconds from one start of `command` to the next."
    )
    timeout: Annotated[Template, SOME_SECONDS] | None = field(
        default=None, description="Seconds that `command` may take."
    )
    failures: Annotated[Template, COUNT] | None = field(
        default=None, description="How often in a row `command` fails until the process hangs."
    )
    abort: Flag | None = field(
        default=None, description="Whether what hangs is ended with SIGABRT first, which leaves a core file."
    )

    def conflict(self) -> Conflict | None:
        """Return what is missing beside what stands here."""
        if self.notify is None and self.message is None and self.min_rate is None and self.command is None:
            return Conflict("`alive` names a sign of life: one or more of `notify`, `message` and `command`")
        if (self.message is None) != (self.min_rate is None):
            together = (
                "`message` and `min_rate` go together: a topic, and how many messages a second are too few"
            )
            return Conflict(together)
        if self.window is not None and self.message is None:
            return Conflict("`window` goes with `message` and `min_rate`", ("window",))
        of_command = {"interval": self.interval, "timeout": self.timeout, "failures": self.failures}
        stray = next((key for key, value in of_command.items() if value is not None), None)
        if stray is None or self.command is not None:
            return None
        return Conflict(f"`{stray}` goes with `command`", (stray,))
