"""What a run is handed by whoever starts it, so that it can be controlled; it imports nothing before that is needed."""

from __future__ import annotations

from orchestra.control.place import forget

TYPE_CHECKING = False  # `typing` itself costs more than this module, which the keeper carries
if TYPE_CHECKING:
    from orchestra.supervise.attendance import Attendant
    from orchestra.supervise.operation import Operation
    from orchestra.supervise.surroundings import Surroundings


def attend(around: Surroundings, operation: Operation, run: str, keeper: int) -> Attendant:
    """Open the control socket, in the supervisor."""
    from orchestra.control.server import attend as opened  # noqa: PLC0415 - only the supervisor needs it

    return opened(around, operation, run, keeper)


def afterwards(run: str) -> None:
    """Remove, in the keeper, what a supervisor that was killed could not."""
    forget(run)
