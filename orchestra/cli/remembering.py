"""Watches how a plan comes about, so that it can be kept for the next launch with the same words: `remembered`."""

from __future__ import annotations

import os
import sys
from contextlib import contextmanager
from importlib import import_module
from typing import TYPE_CHECKING, Any

from orchestra.cli.remembered import key, place
from orchestra.wheels import as_called
from orchestra.witness.observing import observer
from orchestra.witness.origins import loaded
from orchestra.witness.programs import signs
from orchestra.witness.store import Store

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from typing import TextIO


# What look-ups import when they are first used. While somebody watches, an import reads the folders of the
# import path, and a plan would depend on everything that comes and goes there.
_WANTED = ("encodings.utf_8_sig", "unicodedata")
_MOST = 32 * 1024 * 1024  # bytes that all plans may take together


class Memory:
    """What is known of one launch while its plan is made."""

    def __init__(self, kept: Store, name: str) -> None:
        self._store = kept
        self._name = name

    @contextmanager
    def watching(self) -> Iterator[None]:
        """Record everything that is looked at meanwhile, and whether something is printed."""
        for name in _WANTED:
            import_module(name)
        watched = observer()
        watched.install()
        watched.asks = False  # whoever reads the record has nobody to ask
        watched.begin(dict(as_called(os.environ)))
        before = sys.stdout, sys.stderr
        sys.stdout, sys.stderr = (_Noticing(stream) for stream in before)
        try:
            yield
        finally:
            sys.stdout, sys.stderr = before
            watched.rest()

    def keep(self, document: bytes, told: str) -> Callable[[], None] | None:
        """Return what keeps a plan for later launches; None where that cannot be."""
        watched = observer()
        if watched.record is None or watched.record.unknown or watched.record.answers:
            return None

        def written() -> None:
            record = watched.end()
            try:
                code = signs(loaded(watched.code))
            except OSError:  # somebody works on it
                return
            self._store.write(self._name, record, {"told": told, "code": code}, document)
            self._store.prune()

        return written


def memory(words: Sequence[str]) -> Memory | None:
    """Return what a launch is to be remembered by; None where nobody wants that, or there is no place for it."""
    where, name = place(), key(words)
    return None if where is None or name is None else Memory(Store(where, _MOST), name)


class _Noticing:
    """A stream: what is printed while a plan is made would not be printed again."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - whatever the stream has
        return getattr(self._stream, name)

    def write(self, text: str) -> int:
        """Write, and tell that something was written."""
        observer().unknown("something is printed")
        return self._stream.write(text)

    def writelines(self, lines: Iterator[str]) -> None:
        """Write, and tell that something was written."""
        observer().unknown("something is printed")
        self._stream.writelines(lines)
