"""A text file as bytes: encoding, byte order mark and line breaks stay what they are.

Where line breaks are mixed, those of the first line are taken for all.
"""

from __future__ import annotations

import codecs
import re

from orchestra.dataclass import dataclass
from orchestra.formatting.refusal import NotFormatted
from orchestra.load.encodings import DECLARED, decoded

_MARKS = {
    codecs.BOM_UTF8: "utf-8",
    codecs.BOM_UTF16_LE: "utf-16-le",
    codecs.BOM_UTF16_BE: "utf-16-be",
}
_BREAK = re.compile("\r\n|\r|\n")


@dataclass(frozen=True, slots=True)
class TextFile:
    """The text of a file, its line breaks line feeds, and what it is written with."""

    text: str
    mark: bytes
    encoding: str
    line_break: str

    def encoded(self, text: str) -> bytes:
        """Return another text as bytes, written as this one. Raises `UnicodeEncodeError`."""
        return self.mark + text.replace("\n", self.line_break).encode(self.encoding)


def read_text(content: bytes) -> TextFile:
    """Return the text of a file. Raises `UndecodableError`, and `NotFormatted` where it could not be written so."""
    text = decoded(content)
    mark, encoding = next(
        ((mark, name) for mark, name in _MARKS.items() if content.startswith(mark)), (b"", "utf-8")
    )
    declared = DECLARED.match(content)
    for name in (encoding, declared[1].decode("ascii", "replace") if declared else encoding):
        if _is_written(text, mark, name, content):
            first = _BREAK.search(text)
            return TextFile(_BREAK.sub("\n", text), mark, name, first[0] if first else "\n")
    raise NotFormatted("its encoding cannot be written again")


def _is_written(text: str, mark: bytes, encoding: str, content: bytes) -> bool:
    try:
        return mark + text.encode(encoding) == content
    except UnicodeEncodeError:
        return False
