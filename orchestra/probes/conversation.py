"""Talks over a socket without ever waiting for it: a generator says what it waits for, the loop goes on with it."""

from __future__ import annotations

import os
from collections.abc import Callable, Generator
from typing import TYPE_CHECKING, Literal, TypeAlias

if TYPE_CHECKING:
    from orchestra.probes.protocol import Cancel, Waiting

Want: TypeAlias = Literal["read", "write"]
# Yields a descriptor and what it is to be ready for; returns None where all went well, else what is wrong. It closes
# what it opens, also where it is ended before its time.
Steps: TypeAlias = Generator[tuple[int, Want], None, "str | None"]


class Conversation:
    """Takes the steps as the descriptors allow it, for `limit` seconds at most; `told` hears what came of it, once."""

    def __init__(self, loop: Waiting, steps: Steps, limit: float, told: Callable[[str | None], None]) -> None:
        self._loop = loop
        self._steps = steps
        self._told: Callable[[str | None], None] | None = told
        self._descriptor: int | None = None
        late = f"no answer within {limit:g} s"
        self._first: Cancel = loop.call_later(0.0, self._go_on)
        self._timer: Cancel = loop.call_later(limit, lambda: self._end(late))

    def cancel(self) -> None:
        """Break off."""
        self._told = None
        self._end(None)

    def _go_on(self) -> None:
        self._forget()
        try:
            self._descriptor, want = next(self._steps)
        except StopIteration as stop:
            self._end(stop.value)
        except OSError as error:
            self._end(reason(error))
        else:
            wait = self._loop.on_readable if want == "read" else self._loop.on_writable
            wait(self._descriptor, self._go_on)

    def _forget(self) -> None:
        if self._descriptor is not None:
            self._loop.forget(self._descriptor)
            self._descriptor = None

    def _end(self, fault: str | None) -> None:
        self._first.cancel()
        self._timer.cancel()
        self._forget()
        self._steps.close()
        told, self._told = self._told, None
        if told:
            told(fault)


def reason(error: OSError) -> str:
    """Return why something failed, in the words of the system."""
    known = error.errno is not None and error.strerror == os.strerror(error.errno)
    return (error.strerror or str(error)).lower() if known else error.strerror or str(error)
