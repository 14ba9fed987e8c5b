"""Which files have been read, and what was in them: none is read again without need."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.witness import looking

if TYPE_CHECKING:
    from orchestra.witness.record import Record, Signature


class Contents:
    """Completes records with what files hold."""

    def __init__(self) -> None:
        self._digests: dict[str, tuple[Signature | None, str]] = {}
        self._read: dict[str, bytes] = {}

    def opened(self, path: str) -> Signature | None:
        """Return the signature of a file that is about to be read; what was read before counts no more."""
        self._read.pop(path, None)
        return looking.signature(path)

    def read(self, path: str, content: bytes) -> None:
        """Take what a file that was `opened` holds."""
        self._read[path] = content

    def forget(self) -> None:
        """Let go of what was read."""
        self._read.clear()

    def complete(self, record: Record, path: str, before: Signature | None) -> None:
        """Add a file to a record, `before` being its signature before it was read."""
        known, read = self._digests.get(path), self._read.pop(path, None)
        if known is not None and known[0] == before:
            digest: str | None = known[1]
        else:
            digest = looking.content(path, None if before is None else read)
        if digest is None:
            record.unknown = record.unknown or f"{path} is no regular file"
        elif looking.signature(path) != before:
            record.unknown = record.unknown or f"{path} has changed meanwhile"
        else:
            sure = looking.settled(before)
            record.files[path] = (digest, before if sure else None)
            if sure:
                self._digests[path] = (before, digest)
