"""Bytes of one stream to text, in whole lines as far as possible; nothing is lost, whatever the bytes are."""

from __future__ import annotations

import codecs
import re

# A line longer than this goes on in pieces, so that memory stays bounded whatever a program writes.
LONGEST_HELD = 65536
# The begin of a sequence that sets a colour (ECMA-48); cut in two it would be no sequence to whoever looks for it.
_CUT = re.compile(r"\x1b(?:\[[0-9;:]{0,30})?\Z")


class Lines:
    """Collects the bytes of a stream and gives them back as text that ends with a line, where it can.

    Bytes that are not UTF-8 come through as lone surrogates (PEP 383), so encoding with `surrogateescape` restores
    exactly what was written. A character cut by a read is held until the rest is there.
    """

    def __init__(self) -> None:
        self._decoder = codecs.getincrementaldecoder("utf-8")("surrogateescape")
        self._held = ""

    @property
    def unfinished(self) -> bool:
        """Whether the begin of a line is held."""
        return bool(self._held)

    def feed(self, data: bytes) -> str:
        """Take bytes, return the text up to the last end of a line."""
        text = self._held + self._decoder.decode(data)
        end = text.rfind("\n") + 1
        if len(text) - end > LONGEST_HELD:
            end = _uncut(text)
        self._held = text[end:]
        return text[:end]

    def flush(self) -> str:
        """Return the line that is held although it is not finished."""
        end = _uncut(self._held)
        text, self._held = self._held[:end], self._held[end:]
        return text

    def close(self) -> str:
        """Return everything that is left at the end of the stream."""
        text, self._held = self._held, ""
        return text + self._decoder.decode(b"", final=True)


def _uncut(text: str) -> int:
    """Return where to cut an unfinished line: at its end, or before a sequence that has only begun."""
    found = _CUT.search(text, max(0, len(text) - 32))
    return found.start() if found else len(text)
