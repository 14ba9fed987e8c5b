"""What a process waits for, and what others wait for: dependencies, readiness, signs of life."""

from __future__ import annotations

from orchestra.dataclass import dataclass
from orchestra.location import Location
from orchestra.values import Condition, ParameterValue


@dataclass(frozen=True, slots=True)
class Dependency:
    """The process starts only when `process` (a plan id) has reached `condition`; `timeout` in seconds.

    One that is not `required` is waited for as long as it can still come about: its timeout, or the end of the process
    that is waited for, lets the dependent start all the same.
    """

    process: str
    condition: Condition
    timeout: float | None
    location: Location
    required: bool = True


@dataclass(frozen=True, slots=True)
class ParameterFact:
    """The node has declared the parameter; where `value` is given, it has that value."""

    node: str
    name: str
    value: ParameterValue | None = None


@dataclass(frozen=True, slots=True)
class StateFact:
    """The lifecycle node is in a state, by its label (`active`)."""

    node: str
    state: str


@dataclass(frozen=True, slots=True)
class TransformFact:
    """The frame `child` can be transformed into the frame `parent`."""

    parent: str
    child: str


@dataclass(frozen=True, slots=True)
class Ready:
    """When a running process counts as ready: when everything that is not None or False has come about.

    `log` is a regular expression on a line of its output. `tcp` is `HOST:PORT` that accepts a connection, `http` a URL
    that answers with a status from 200 to 399, `file` a path that exists, `command` an argv that exits with 0: these
    are tried every `interval` seconds, from the working directory and in the environment of the process. `notify`: the
    process says `READY=1` to the socket in NOTIFY_SOCKET (sd_notify(3)). The others are facts of the ROS graph, with
    full names: `node` is there, `topic` has a publisher, `message` is a topic whose first message has come, `service`
    and `action` have a server. `timeout` in seconds, None for ever.
    """

    log: str | None
    message: str | None
    timeout: float | None
    tcp: str | None = None
    http: str | None = None
    file: str | None = None
    command: tuple[str, ...] | None = None
    notify: bool = False
    node: str | None = None
    topic: str | None = None
    service: str | None = None
    action: str | None = None
    parameter: ParameterFact | None = None
    lifecycle: StateFact | None = None
    tf: TransformFact | None = None
    interval: float = 0.2


@dataclass(frozen=True, slots=True)
class Alive:
    """Signs of life that a process has to give once it is ready, else it hangs and is ended as failed.

    `notify`: `WATCHDOG=1` comes at least every so many seconds (sd_notify(3)). `message`: a topic, by its full name,
    with at least `min_rate` messages a second on the average of `window` seconds. `command`: an argv that, started
    every `interval` seconds, exits with 0 within `timeout` seconds; `failures` of it in a row are a hang. `abort` ends
    the hung process with SIGABRT first, which leaves a core file, and the stacks of a Python program.
    """

    notify: float | None = None
    message: str | None = None
    min_rate: float | None = None
    window: float = 2.0
    command: tuple[str, ...] | None = None
    interval: float = 5.0
    timeout: float = 2.0
    failures: int = 3
    abort: bool = False
