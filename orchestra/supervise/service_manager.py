"""Tells the service manager that has started us how the run is doing (sd_notify(3)).

The supervisor tells it, not the keeper, whose pid the service manager knows: it is the one that knows, and that it goes
on telling is the sign that it does not hang. So the unit needs NotifyAccess=all (docs/service-manager.md).

Nothing here waits: what the service manager does not take now is told later, the newest of each kind.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from orchestra.supervise.process.life import FINAL, LIVE, Phase

if TYPE_CHECKING:
    import socket
    from collections.abc import Callable, Collection

    from orchestra.supervise.loop import Loop, Timer
    from orchestra.supervise.process.life import State
    from orchestra.supervise.summons import Summons

# What the service manager has no room for is tried again after this time, in seconds.
_AGAIN = 0.1
# It shows the status on one line.
_LONGEST = 200
# It is asked to wait so much longer than our own deadline, in seconds.
_MARGIN = 5.0
_NAMED = 3


class Known(Protocol):
    """A process, as far as it is told of."""

    @property
    def id(self) -> str:
        """Its id in the plan."""

    @property
    def name(self) -> str:
        """Its name for people."""

    @property
    def state(self) -> State:
        """Where it is in its life."""

    @property
    def awaited(self) -> str:
        """What its readiness waits for, in words."""


class ServiceManager:
    """Who has started us, where that is a service manager; else nothing is told. `say` hears of what goes wrong."""

    def __init__(self, loop: Loop, summons: Summons, say: Callable[[str], None]) -> None:
        self._loop = loop
        self._say = say
        self._socket: socket.socket | None = None
        self._address = ""
        self._told: dict[str, str] = {}
        self._waiting: dict[str, str] = {}
        self._again: Timer | None = None
        self._beat: Timer | None = None
        if summons.address is not None:
            self._open(summons.address)
        if self._socket and summons.period is not None:
            self._live(summons.period / 2)

    def reading(self) -> None:
        """The description is being read."""
        self._tell(STATUS="reading the description")

    def changed(self, units: Collection[Known], held: Callable[[str], bool], remaining: float | None) -> None:
        """Something has changed: `held` names those that only a trigger starts.

        `remaining` is the time until all is killed, in seconds, where the run is ending.
        """
        if not self._socket:
            return
        words = status(units, held)
        if remaining is not None:
            self._stop(f"stopping: {words}", remaining)
        elif all(settled(unit, held) for unit in units):
            self._tell(READY="1", STATUS=words)
        else:
            self._tell(STATUS=words)

    def ended(self, words: str) -> None:
        """The run is over."""
        self._tell(STOPPING="1", STATUS=words[:_LONGEST])

    def close(self) -> None:
        """Tell nothing any more."""
        for timer in (self._again, self._beat):
            if timer:
                timer.cancel()
        if self._socket:
            self._socket.close()
            self._socket = None

    def _open(self, address: str) -> None:
        if not address.startswith(("/", "@")):
            self._say(f"the service manager is not told anything: NOTIFY_SOCKET={address} is no unix socket")
            return
        import socket  # noqa: PLC0415 - most runs are started by people

        self._address = f"\0{address[1:]}" if address.startswith("@") else address
        self._socket = socket.socket(
            socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_NONBLOCK | socket.SOCK_CLOEXEC
        )

    def _live(self, pause: float) -> None:
        """Give a sign of life, and the next after a pause: whoever is stuck does not."""
        self._send("WATCHDOG=1")
        self._beat = self._loop.call_later(pause, lambda: self._live(pause))

    def _stop(self, words: str, remaining: float) -> None:
        if "STOPPING" in self._told:
            self._tell(STATUS=words)
        else:
            wanted = str(round((max(0.0, remaining) + _MARGIN) * 1e6))
            self._tell(STOPPING="1", EXTEND_TIMEOUT_USEC=wanted, STATUS=words)

    def _tell(self, **assignments: str) -> None:
        """Tell what has not been told before."""
        if not self._socket:
            return
        lines = {name: "".join(filter(str.isprintable, value)) for name, value in assignments.items()}
        new = {name: value for name, value in lines.items() if self._told.get(name) != value}
        self._told |= new
        self._waiting |= new
        if self._waiting and self._again is None:
            self._send_waiting()

    def _send_waiting(self) -> None:
        self._again = None
        if self._send("\n".join(f"{name}={value}" for name, value in self._waiting.items())):
            self._waiting.clear()
        else:
            self._again = self._loop.call_later(_AGAIN, self._send_waiting)

    def _send(self, message: str) -> bool:
        """Send a message; False where there is no room for it now. After any other failure nothing more is sent."""
        if not self._socket:
            return True
        try:
            self._socket.sendto(message.encode("utf-8", "replace"), self._address)
        except BlockingIOError:
            return False
        except OSError as error:
            self._say(f"the service manager is not told anything more: {error.strerror}")
            self.close()
        return True


def settled(unit: Known, held: Callable[[str], bool]) -> bool:
    """Tell whether nothing is waited for: it was ready, or it has begun where nothing says when it is, or is over."""
    return unit.state.been_ready or unit.state.phase in FINAL or held(unit.id)


def status(units: Collection[Known], held: Callable[[str], bool]) -> str:
    """Return how the processes stand, in one line."""
    running = sum(unit.state.phase in LIVE for unit in units)
    parts = [f"{running} of {len(units)} running"]
    failed = [unit.name for unit in units if unit.state.phase is Phase.FAILED]
    again = [unit.name for unit in units if unit.state.phase is Phase.RESTARTING]
    awaited = [
        f"{unit.name} ({unit.awaited})" if unit.state.phase is Phase.RUNNING else unit.name
        for unit in units
        if not settled(unit, held)
    ]
    for what, names in (("failed", failed), ("starting again", again), ("waiting for", awaited)):
        if names:
            more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
            parts.append(f"{what} {', '.join(names[:_NAMED])}{more}")
    return "; ".join(parts)[:_LONGEST]
