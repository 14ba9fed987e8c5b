"""Clients that see what a process writes, byte by byte, and type what it reads.

    attach {"process": NAME, "columns": N, "lines": N}   answers {"process": ID, "takes_input": BOOL}
        server  {"output": BASE64, "missed": N}          N bytes before it came faster than the client took them
        server  {"detached": TEXT}                       the process has ended for good
    input  {"data": BASE64}                              answers {"taken": N}: the rest may be tried again
    resize {"columns": N, "lines": N}
    detach

A connection is attached to one process at a time. A process that starts again stays attached.
"""

from __future__ import annotations

import base64
import binascii
from typing import TYPE_CHECKING, Any

from orchestra.control import protocol
from orchestra.control.protocol import Refusal
from orchestra.supervise.process.life import FINAL

if TYPE_CHECKING:
    from orchestra.control.guest import Guest
    from orchestra.supervise.loop import Loop
    from orchestra.supervise.operation import Operation
    from orchestra.supervise.output.attachment import Attachment
    from orchestra.supervise.process.unit import Unit

# No more output is taken for a client while it has so much to read, in bytes.
_ENOUGH = 65536
_WIDEST = 65535


class _Attached:
    """One client at one process."""

    def __init__(self, guest: Guest, unit: Unit) -> None:
        self.unit = unit
        self._guest = guest
        self._tap = unit.attachment.tap(self.deliver)

    def deliver(self) -> None:
        """Send what there is, as far as the client takes it."""
        while self._guest.open and self._guest.pending < _ENOUGH:
            data = self._tap.take(_ENOUGH)
            if not data:
                return
            missed, self._tap.missed = self._tap.missed, 0
            self._guest.send(protocol.encode({"output": base64.b64encode(data).decode(), "missed": missed}))

    def leave(self) -> None:
        """See no more."""
        self._tap.close()


class Attaching:
    """Knows which clients are attached, and to what."""

    def __init__(self, loop: Loop, operation: Operation) -> None:
        self._loop = loop
        self._operation = operation
        self._attached: dict[Guest, _Attached] = {}
        self._looking = False

    def begin(self, guest: Guest, process: str, given: dict[str, Any]) -> dict[str, Any]:
        """Attach a client and return the answer. Raises `Refusal`."""
        if guest in self._attached:
            raise Refusal("refused", "this connection is attached to a process already")
        unit = self._operation.unit(process)
        if unit.state.phase in FINAL:
            raise Refusal("refused", f"{unit.name} does not run")
        _resize(unit.attachment, given)
        attached = self._attached[guest] = _Attached(guest, unit)
        guest.at_leave(lambda: self._leave(guest))
        guest.at_drain(attached.deliver)
        return {"process": process, "takes_input": unit.attachment.takes_input}

    def input(self, guest: Guest, given: dict[str, Any]) -> dict[str, Any]:
        """Type what a client sends. Raises `Refusal`."""
        data = given.get("data")
        try:
            typed = base64.b64decode(data if isinstance(data, str) else "", validate=True)
        except (binascii.Error, ValueError):
            raise Refusal("malformed", "'data' is in base64") from None
        return {"taken": self._of(guest).unit.attachment.write(typed) if typed else 0}

    def resize(self, guest: Guest, given: dict[str, Any]) -> dict[str, Any]:
        """Give the terminal of the process the size of the client's. Raises `Refusal`."""
        _resize(self._of(guest).unit.attachment, given)
        return {}

    def detach(self, guest: Guest) -> dict[str, Any]:
        """Let a client see no more. Raises `Refusal`."""
        self._of(guest)
        self._leave(guest)
        return {}

    def happened(self) -> None:
        """Something has happened: see, when it is done, whose process has ended."""
        if self._attached and not self._looking:
            self._looking = True
            self._loop.call_later(0.0, self._look)

    def _look(self) -> None:
        self._looking = False
        for guest, attached in tuple(self._attached.items()):
            state = attached.unit.state
            if state.phase in FINAL:
                attached.deliver()
                self._leave(guest)
                guest.send(protocol.encode({"detached": str(state.ending or state.phase)}))

    def _leave(self, guest: Guest) -> None:
        attached = self._attached.pop(guest, None)
        if attached:
            attached.leave()
            guest.at_drain(None)

    def _of(self, guest: Guest) -> _Attached:
        if guest not in self._attached:
            raise Refusal("refused", "this connection is attached to no process")
        return self._attached[guest]


def _resize(attachment: Attachment, given: dict[str, Any]) -> None:
    """Take note of a size; none is given where the client has no terminal."""
    size = [given.get("columns"), given.get("lines")]
    if size == [None, None]:
        return
    columns, lines = (number if type(number) is int and 0 < number <= _WIDEST else 0 for number in size)
    if not columns or not lines:
        raise Refusal("malformed", "'columns' and 'lines' are numbers from 1 to 65535")
    attachment.resize(columns, lines)
