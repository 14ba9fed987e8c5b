"""Bytes of one stream, in whole lines as far as possible; nothing is lost, whatever the bytes are."""

from __future__ import annotations

import re
from typing import Final

# A line longer than this goes on in pieces, so that memory stays bounded whatever a program writes.
LONGEST_HELD = 65536
# The begin of a sequence that sets a colour (ECMA-48), or of a character in UTF-8 (RFC 3629); cut in two they would be
# neither to whoever looks for them.
_CUT: Final = (
    rb"(?:\x1b(?:\[[0-9;:]{0,30})?|[\xc2-\xdf]|[\xe0-\xef][\x80-\xbf]?|[\xf0-\xf4][\x80-\xbf]{0,2})\Z"
)
_LONGEST_CUT = 32


class Lines:
    """Collects the bytes of a stream and gives them back up to the end of a line, where it can.

    A character cut by a read is held until the rest is there.
    """

    def __init__(self) -> None:
        self._held = b""

    @property
    def unfinished(self) -> bool:
        """Whether the begin of a line is held."""
        return bool(self._held)

    def feed(self, data: bytes) -> bytes:
        """Take bytes, return those up to the last end of a line."""
        end = data.rfind(b"\n") + 1
        if end:
            whole = self._held + memoryview(data)[:end] if self._held else data[:end]
            self._held = data[end:]
        else:
            whole, self._held = b"", self._held + data
        return whole if len(self._held) <= LONGEST_HELD else whole + self.flush()

    def flush(self) -> bytes:
        """Return the line that is held although it is not finished."""
        end = _uncut(self._held)
        data, self._held = self._held[:end], self._held[end:]
        return data

    def close(self) -> bytes:
        """Return everything that is left at the end of the stream."""
        data, self._held = self._held, b""
        return data


def _uncut(data: bytes) -> int:
    """Return where to cut an unfinished line: at its end, or before what has only begun."""
    found = re.search(_CUT, data[-_LONGEST_CUT:])
    return len(data) - len(found[0]) if found else len(data)
