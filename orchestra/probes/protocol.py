"""What every readiness condition can do, and what it is given to work with."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Literal, NamedTuple, Protocol, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.values import ParameterValue

Fact: TypeAlias = Literal[
    "node", "topic", "message", "service", "action", "parameter", "lifecycle", "tf"
]  # fmt: skip


@dataclass(frozen=True, slots=True)
class Request:
    """What the observer is to look for in the ROS graph: a fact, and the names and values that it is about."""

    fact: Fact
    about: dict[str, ParameterValue] = field(default_factory=dict)

    @property
    def order(self) -> dict[str, Any]:
        """The order to the observer, as JSON data."""
        return {"do": "watch", "fact": self.fact, **self.about}


class Result(NamedTuple):
    """What came of a program: `fault` is None where it exited with 0; `output` is the end of its standard output."""

    fault: str | None
    output: bytes = b""


class Cancel(Protocol):
    """Something under way that can be given up."""

    def cancel(self) -> None:
        """Give it up: nothing more is told, and everything is given back. Harmless where it is over."""


class Waiting(Protocol):
    """The loop, as far as a probe needs it."""

    def call_later(self, delay: float, callback: Callable[[], object]) -> Cancel:
        """Call once after `delay` seconds."""

    def on_readable(self, descriptor: int, callback: Callable[[], object]) -> None:
        """Call whenever the descriptor can be read."""

    def on_writable(self, descriptor: int, callback: Callable[[], object]) -> None:
        """Call whenever the descriptor can be written."""

    def forget(self, descriptor: int) -> None:
        """Call no more for this descriptor."""


@dataclass(frozen=True, slots=True)
class Site:
    """Where a probe works: what it may use for one run of a process.

    `folder` is the working directory of the process, None for our own. `run` starts a program there, in the environment
    of the process, and ends it after so many seconds. `watch` asks the observer and hears None when the fact has come
    about, else why nobody can tell. `on_output` and `on_notice` hear pieces of its output (stream, text), and values of
    one variable of its notifications, until the wait is over.
    """

    loop: Waiting
    folder: str | None
    run: Callable[[Sequence[str], float, Callable[[Result], None]], Cancel]
    watch: Callable[[Request, Callable[[str | None], None]], Cancel]
    on_output: Callable[[Callable[[str, str], None]], None]
    on_notice: Callable[[str, Callable[[str], None]], None]
    impossible: Callable[[str], None]


class Probe(Protocol):
    """A readiness condition, for one run of a process."""

    @property
    def words(self) -> str:
        """What is awaited, for messages: "a message on /clock"; and what came of the latest attempt."""

    @property
    def looks_into_graph(self) -> bool:
        """Whether it needs the observer."""

    def begin(self, site: Site, came: Callable[[], None]) -> None:
        """Look out from now on; `came` is called once, later, when it has come about."""

    def end(self) -> None:
        """Look out no longer, and give everything back."""
