"""The server's side of the control socket. It lives in the supervisor, on its loop, and never waits for a client.

A client that says nothing costs a descriptor, one that does not read what it is sent is dropped when a megabyte waits
for it, one that speaks garbage is told so; there are at most a hundred and a few of them.
"""

from __future__ import annotations

import os
import select
import socket
import time
from typing import TYPE_CHECKING, Any

from orchestra.control import door, protocol
from orchestra.control.attaching import Attaching
from orchestra.control.guest import Guest
from orchestra.control.protocol import Refusal
from orchestra.control.requests import Desk, handler_of
from orchestra.control.subscribers import Subscribers
from orchestra.control.waiting import Waiting

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.control.protocol import Request
    from orchestra.supervise.loop import Loop
    from orchestra.supervise.operation import Operation
    from orchestra.supervise.surroundings import Surroundings

MOST_CLIENTS = 128
_ACCEPTED_PER_TURN = 16
# No client gets the last descriptors: what starts and ends processes needs some, and imports modules then.
_KEPT_BACK = 16
_NONE_LEFT = "the supervisor has no file descriptor left for clients"
# How long the last events may take on their way to clients that read slowly, all together, in seconds.
_PARTING = 0.2


class Server:
    """Receives clients at a listening socket, and has `serve` see to their requests."""

    def __init__(
        self,
        loop: Loop,
        listener: socket.socket,
        hello: dict[str, Any],
        serve: Callable[[Guest, Request], None],
    ) -> None:
        self._loop = loop
        self._listener = listener
        self._hello = protocol.encode(hello)
        self._serve = serve
        self._guests: set[Guest] = set()
        # Given up where no other descriptor is left, so that a client can be sent away instead of waiting for ever.
        self._reserve = os.open(os.devnull, os.O_RDONLY | os.O_CLOEXEC)
        loop.on_readable(listener.fileno(), self._accept)

    @property
    def clients(self) -> int:
        """The number of clients."""
        return len(self._guests)

    def close(self) -> None:
        """Send what is on its way, for a moment, and part from everybody."""
        self._loop.forget(self._listener.fileno())
        self._listener.close()
        self._part()
        for guest in tuple(self._guests):
            guest.leave()
        os.close(self._reserve)

    def _accept(self) -> None:
        for _ in range(_ACCEPTED_PER_TURN):
            try:
                connection, _ = self._listener.accept()
            except BlockingIOError:
                return
            except OSError:
                self._send_away_unseen()
                return
            connection.setblocking(False)
            self._receive(connection)

    def _receive(self, connection: socket.socket) -> None:
        if door.owner(connection) != os.getuid():
            _send_away(connection, Refusal("foreign", "only the user whose run it is may control it"))
        elif len(self._guests) >= MOST_CLIENTS and not self._makes_room():
            _send_away(connection, Refusal("busy", f"there are {MOST_CLIENTS} clients already"))
        elif 0 < os.sysconf("SC_OPEN_MAX") <= connection.fileno() + _KEPT_BACK:  # the kernel gives the lowest
            _send_away(connection, Refusal("busy", _NONE_LEFT))
        else:
            guest = Guest(self._loop, connection, self._serve, self._guests.discard)
            self._guests.add(guest)
            guest.send(self._hello)

    def _makes_room(self) -> bool:
        """Part from those who have hung up, which the kernel may tell later than of a new client."""
        for guest in tuple(self._guests):
            guest.catch_up()
        return len(self._guests) < MOST_CLIENTS

    def _send_away_unseen(self) -> None:
        """Free a descriptor for as long as it takes to hang up on whoever wants in."""
        os.close(self._reserve)
        try:
            connection, _ = self._listener.accept()
        except OSError:
            pass
        else:
            connection.setblocking(False)
            _send_away(connection, Refusal("busy", _NONE_LEFT))
        finally:
            self._reserve = os.open(os.devnull, os.O_RDONLY | os.O_CLOEXEC)

    def _part(self) -> None:
        """Wait a moment for those who read what they are sent, and are not through with it."""
        deadline = time.monotonic() + _PARTING
        while slow := {guest.descriptor(): guest for guest in self._guests if guest.pending}:
            poll = select.poll()
            for descriptor in slow:
                poll.register(descriptor, select.POLLOUT)
            found = poll.poll(max(0.0, deadline - time.monotonic()) * 1000)
            for descriptor, _ in found:
                slow[descriptor].push()
            if not found:
                return


def _send_away(connection: socket.socket, why: Refusal) -> None:
    try:
        connection.send(protocol.refusal(None, why))
    except OSError:
        return  # it has gone already
    finally:
        connection.close()


class Control:
    """The control socket of a run, where `entrance` stands."""

    def __init__(self, around: Surroundings, desk: Desk, hello: dict[str, Any], entrance: door.Door) -> None:
        self._around = around
        self._desk = desk
        self._path = entrance.path
        listener = socket.socket(fileno=entrance.listener)
        listener.setblocking(False)
        self._server = Server(around.loop, listener, hello, self._serve)
        around.recorder.listen(self._happened)

    def close(self) -> None:
        """Answer what is still open, and remove the socket."""
        self._desk.waiting.end()
        self._server.close()
        try:
            door.remove(self._path)
        except OSError as error:
            self._around.journal.say(f"the control socket cannot be removed: {door.told(error)}")

    def _happened(self, line: str) -> None:
        self._desk.subscribers.happened(line)
        self._desk.waiting.happened()
        self._desk.attaching.happened()

    def _serve(self, guest: Guest, request: Request) -> None:
        """See to a request. Whatever a client may have found to break, the run goes on without this one answer."""
        try:
            handler_of(request.name)(self._desk, guest, request)
        except Refusal as why:
            guest.send(protocol.refusal(request.id, why))
        except Exception as error:  # noqa: BLE001 - see above; it is told, and the client hears of it
            what = f"a bug in Orchestra: {type(error).__name__}: {error}"
            self._around.journal.say(f"the request '{request.name:.40}' has met {what}")
            guest.send(protocol.refusal(request.id, Refusal("bug", what)))


def attend(
    around: Surroundings, operation: Operation, marks: tuple[str, int], entrance: door.Door
) -> Control:
    """See to the clients of a run; `marks` are its own and the keeper's pid."""
    run, keeper = marks
    hello = {
        "protocol": protocol.VERSION,
        "run": run,
        "name": around.options.name,
        "directory": str(around.folder),
        "keeper": keeper,
        "supervisor": os.getpid(),
    }
    subscribers = Subscribers(around.recorder)
    desk = Desk(
        hello, operation, subscribers, Waiting(around.loop, operation), Attaching(around.loop, operation)
    )
    return Control(around, desk, hello, entrance)
