"""Who hears of every event as it is written."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.control import protocol

if TYPE_CHECKING:
    from orchestra.control.guest import Guest
    from orchestra.supervise.output.recorder import Recorder


class Subscribers:
    """Hands events on to the clients that want them. `count` is that of the events so far."""

    def __init__(self, recorder: Recorder) -> None:
        self._recorder = recorder
        self._guests: list[Guest] = []

    @property
    def count(self) -> int:
        """The number of events of the run so far."""
        return self._recorder.count

    def add(self, guest: Guest) -> None:
        """Let a client have every event from now on, each once."""
        if guest in self._guests:
            return
        self._guests.append(guest)
        guest.at_leave(lambda: self._guests.remove(guest))

    def happened(self, line: str) -> None:
        """Hand on the line of an event; it is written down once for all of them."""
        if not self._guests:
            return
        message = protocol.encode_event(line, self.count)
        for guest in tuple(self._guests):
            guest.send(message)
