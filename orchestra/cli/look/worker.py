"""The life of a process of a pool: it turns pieces into results until nobody has any more, see `pool`."""

from __future__ import annotations

import json
import os
import signal
import struct
import sys
from time import monotonic
from typing import TYPE_CHECKING, Any, Final, Protocol

from orchestra.dataclass import dataclass
from orchestra.resolve.command_reaper import end_with_parent

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import BinaryIO, NoReturn

_HEAD: Final = struct.Struct("!Q")


@dataclass(frozen=True, slots=True)
class Done:
    """The result of one piece, as JSON data; with `last` its process takes no other."""

    result: Any
    last: bool = False


class Work(Protocol):
    """What a process of a pool does."""

    def foresee(self, piece: int) -> None:
        """Do what a piece needs and can be done for several after each other, before they are turned into results."""

    def turn(self, piece: int) -> Done:
        """Turn a piece, told by its number, into a result."""

    def end(self) -> None:
        """Do what is left to do: this process takes no more."""


@dataclass(frozen=True, slots=True)
class Channels:
    """What a process of a pool has to do with the one that has forked it.

    `orders` and `answers` are descriptors; an order without a piece is the last one. `progress` is memory of both: the
    place, in what was ordered last, of the piece that is being worked on, and when that was begun.
    """

    orders: int
    answers: int
    progress: memoryview[float]


def work(channels: Channels, begin: Callable[[], Work], parent: int) -> NoReturn:
    """Turn the pieces that are ordered into results, and end this process."""
    status, own = 1, os.getpid()
    try:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        end_with_parent()
        if os.getppid() == parent:
            os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
            os.dup2(2, 1)
            doing = begin()
            with open(channels.orders, "rb", closefd=False) as stream:
                while pieces := receive(stream):
                    results = _results(pieces, doing, channels.progress, own)
                    if os.getpid() != own:  # code of a piece has forked, and this is the other one
                        break
                    if results["last"]:
                        doing.end()
                    send(channels.answers, results)
                else:
                    doing.end()
            status = 0
    except KeyboardInterrupt:  # raised by code of the piece: a real one ends this process at once
        status = 128 + signal.SIGINT
    except BaseException:  # noqa: BLE001 - nothing may get out of this process into code of the other one
        if os.getpid() == own:
            import traceback  # noqa: PLC0415 - slow, and only a bug needs it

            send(channels.answers, {"failed": traceback.format_exc()})
    finally:
        sys.stderr.flush()
        os._exit(status)


def _results(pieces: Sequence[int], work: Work, progress: memoryview[float], own: int) -> dict[str, Any]:
    results: list[Any] = []
    last = False
    for place, piece in enumerate(pieces if len(pieces) > 1 else ()):
        progress[0], progress[1] = place, monotonic()
        work.foresee(piece)
    for place, piece in enumerate(pieces):
        progress[0], progress[1] = place, monotonic()
        done = work.turn(piece)
        results.append(done.result)
        last = done.last
        if last or os.getpid() != own:
            break
    return {"results": results, "last": last}


def send(descriptor: int, message: object) -> None:
    """Write JSON data, which `receive` and `received` read."""
    body = json.dumps(message).encode()
    left = memoryview(_HEAD.pack(len(body)) + body)
    while left:
        left = left[os.write(descriptor, left) :]


def receive(stream: BinaryIO) -> Any:  # noqa: ANN401 - JSON data
    """Return what was sent; None where nobody sends any more."""
    head = stream.read(_HEAD.size)
    return json.loads(stream.read(_HEAD.unpack(head)[0])) if head else None


def received(content: bytearray) -> Any:  # noqa: ANN401 - JSON data
    """Return what was sent if it has come as a whole; None where some of it is missing."""
    if len(content) < _HEAD.size or len(content) < _HEAD.size + _HEAD.unpack_from(content)[0]:
        return None
    return json.loads(content[_HEAD.size :])
