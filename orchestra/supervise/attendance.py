"""What attends to a run from above: the control socket, handed in by who starts the run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import TypeAlias

    from orchestra.supervise.operation import Operation
    from orchestra.supervise.surroundings import Surroundings


class Attendant(Protocol):
    """Something that lives as long as the run."""

    def close(self) -> None:
        """Give everything back; called once, after the last event."""


if TYPE_CHECKING:
    # Called in the supervisor process when the run is about to begin, with the mark of the run and the keeper's pid.
    # What it raises is a bug.
    Attend: TypeAlias = Callable[[Surroundings, Operation, str, int], Attendant]
