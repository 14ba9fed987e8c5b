"""What a run is handed by whoever starts it, so that it can be controlled; it imports nothing before that is needed."""

from __future__ import annotations

from orchestra.control.place import forget

TYPE_CHECKING = False  # `typing` itself costs more than this module, which the keeper carries
if TYPE_CHECKING:
    from orchestra.control.door import Door
    from orchestra.supervise.attendance import Attendant
    from orchestra.supervise.operation import Operation
    from orchestra.supervise.surroundings import Surroundings


def attend(around: Surroundings, operation: Operation, run: str, keeper: int) -> Attendant:
    """Open the control socket, in the supervisor."""
    return _Entrance(around, operation, run, keeper)


def afterwards(run: str) -> None:
    """Remove, in the keeper, what a supervisor that was killed could not."""
    forget(run)


class _Entrance:
    """The control socket: clients can knock from the begin on, and are let in when what begins at once has begun."""

    def __init__(self, around: Surroundings, operation: Operation, run: str, keeper: int) -> None:
        from orchestra.control.door import opened  # noqa: PLC0415 - only the supervisor needs it

        self._around = around
        self._operation = operation
        self._run = run
        self._keeper = keeper
        self._door: Door | None = opened(around, run)
        self._inside: Attendant | None = None
        self._timer = around.loop.call_later(0.0, self._wait)

    def close(self) -> None:
        """Remove the socket."""
        self._timer.cancel()
        if self._inside is None:
            self._enter()
        if self._inside is not None:
            self._inside.close()

    def _wait(self) -> None:
        self._timer = self._around.loop.call_later(0.0, self._enter)

    def _enter(self) -> None:
        if self._door is not None:
            from orchestra.control.server import attend as served  # noqa: PLC0415 - no first process waits for it

            self._inside = served(self._around, self._operation, (self._run, self._keeper), self._door)
