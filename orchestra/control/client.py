"""The client's side of the control socket: asks, waits for the answer, and hears of events."""

from __future__ import annotations

import json
from collections import deque
from typing import TYPE_CHECKING, Any

from orchestra.control import door, protocol
from orchestra.control.protocol import Refusal

if TYPE_CHECKING:
    import socket
    from collections.abc import Iterator
    from pathlib import Path
    from types import TracebackType
    from typing import Self

# A supervisor that lives says who it is at once; in seconds.
_HELLO_WITHIN = 10.0
_READ_SIZE = 65536


class GoneError(Exception):
    """Nobody is there to talk to, or not any more; the message says why."""


class Client:
    """A connection to a run; `run` is its hello. Raises `GoneError` where there is none, or not any more."""

    def __init__(self, directory: Path) -> None:
        self._received = bytearray()
        self._events: deque[dict[str, Any]] = deque()
        self._requests = 0
        self._connection = _connected(directory)
        self._connection.settimeout(_HELLO_WITHIN)
        try:
            self.run = self._greeted()
        except BaseException:
            self.close()
            raise
        self._connection.settimeout(None)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Hang up."""
        self._connection.close()

    def fileno(self) -> int:
        """The descriptor of the connection, to wait for."""
        return self._connection.fileno()

    def ask(self, request: str, **given: Any) -> dict[str, Any]:  # noqa: ANN401 - JSON
        """Ask and return the answer; events that come meanwhile are kept. Raises `Refusal`."""
        number = self.send(request, **given)
        while True:
            message = self._next()
            if "event" in message:
                self._events.append(message)
            elif message.get("id") in (number, None):
                return _result(message)

    def send(self, request: str, **given: Any) -> int:  # noqa: ANN401 - JSON
        """Ask, and return the number that the answer has as its id."""
        self._requests += 1
        try:
            self._connection.sendall(protocol.encode({"id": self._requests, "request": request, **given}))
        except OSError as error:
            raise GoneError(f"the run takes no request any more: {error.strerror or error}") from error
        return self._requests

    def messages(self) -> Iterator[dict[str, Any]]:
        """Yield what comes, in order, beginning with the events that are kept, until the run hangs up."""
        while True:
            try:
                yield self._events.popleft() if self._events else self._next()
            except GoneError:
                return

    def await_event(self) -> None:
        """Wait until something has happened since the last time, and forget what it was. Raises `GoneError`."""
        while not self._events:
            self._events.append(self._next())
        self._events.clear()

    def arrived(self) -> list[dict[str, Any]]:
        """Read once, where there is something, and return what is complete. Raises `GoneError` at the end."""
        self._read()
        return list(iter(self._complete, None))

    def _greeted(self) -> dict[str, Any]:
        try:
            hello = self._next()
        except TimeoutError:
            raise GoneError(f"its supervisor has not answered within {_HELLO_WITHIN:g} s") from None
        if "error" in hello:
            _result(hello)
        if hello.get("protocol") != protocol.VERSION:
            raise GoneError(
                f"it speaks version {hello.get('protocol')} of the protocol, not {protocol.VERSION}"
            )
        return hello

    def _next(self) -> dict[str, Any]:
        while (message := self._complete()) is None:
            self._read()
        return message

    def _complete(self) -> dict[str, Any] | None:
        end = self._received.find(b"\n")
        if end < 0:
            return None
        line = bytes(self._received[:end])
        del self._received[: end + 1]
        message: dict[str, Any] = json.loads(line)
        return message

    def _read(self) -> None:
        try:
            data = self._connection.recv(_READ_SIZE)
        except ConnectionResetError:
            data = b""
        if not data:
            raise GoneError("the run has hung up")
        self._received += data


def _connected(directory: Path) -> socket.socket:
    path = door.linked(directory)
    if path is None:
        raise GoneError("it has no control socket")
    try:
        return door.connect(path)
    except OSError as error:
        raise GoneError(f"its control socket cannot be reached: {error.strerror or error}") from error


def _result(message: dict[str, Any]) -> dict[str, Any]:
    """Return the result that an answer has. Raises `Refusal`."""
    if "error" in message:
        raise Refusal(message["error"]["code"], message["error"]["message"])
    result: dict[str, Any] = message["result"]
    return result
