"""Reads ahead in a thread: a chunk of an MCAP is parsed as a whole, which would hold up the messages that are due."""

from __future__ import annotations

from itertools import islice
from queue import Full, Queue
from threading import Event, Thread
from typing import TYPE_CHECKING, Final, TypeVar

if TYPE_CHECKING:
    from collections.abc import Generator, Iterable

_ItemT = TypeVar("_ItemT")

_AT_ONCE: Final = 100
_BATCHES: Final = 200
_LOOK: Final = 0.1  # how soon a reader sees that nobody wants more


def ahead(items: Iterable[_ItemT]) -> Generator[_ItemT, None, None]:
    """Yield what an iterable yields, which a thread uses some way ahead. It raises what that does."""
    batches: Queue[list[_ItemT] | BaseException] = Queue(_BATCHES)
    unwanted = Event()

    def hand_over(batch: list[_ItemT] | BaseException) -> None:
        while not unwanted.is_set():
            try:
                batches.put(batch, timeout=_LOOK)
            except Full:
                continue
            return

    def read() -> None:
        source = iter(items)
        try:
            while not unwanted.is_set():
                batch = list(islice(source, _AT_ONCE))
                hand_over(batch)
                if not batch:
                    return
        except BaseException as error:  # noqa: BLE001 - it is raised again where somebody waits for more
            hand_over(error)

    reader = Thread(target=read, name="ahead")
    reader.start()
    try:
        while batch := batches.get():
            if isinstance(batch, BaseException):
                raise batch
            yield from batch
    finally:
        unwanted.set()
        reader.join()
