"""From the bytes of a file to its text: UTF-8, UTF-16 or UTF-32 with a mark, XML in UTF-16, or what that declares.

UTF-8 comes first whatever is declared, as upstream: editors save UTF-8 and leave old declarations as they are.
"""

from __future__ import annotations

import codecs
from typing import Final

from orchestra.patterns import pattern

DECLARED: Final = pattern(rb"""\s*<\?xml\s[^>]*?\bencoding\s*=\s*["']([^"']*)["']""")
# In this order: the mark of UTF-16 begins that of UTF-32.
_WIDE: Final = {
    codecs.BOM_UTF32_LE: "utf-32",
    codecs.BOM_UTF32_BE: "utf-32",
    codecs.BOM_UTF16_LE: "utf-16",
    codecs.BOM_UTF16_BE: "utf-16",
}
# XML without a mark, which expat reads whatever it is told (XML 1.0, appendix F).
_UNMARKED: Final = pattern(rb"<\0[^\0]\0|(\0<\0[^\0])")


class UndecodableError(Exception):
    """The bytes are no text; `line` and `column` are those of the first that is none."""

    def __init__(self, reason: str, before: str) -> None:
        super().__init__(reason)
        self.line = before.count("\n") + 1
        self.column = len(before) - before.rfind("\n")


def decoded(content: bytes) -> str:
    """Return the text of a file without its byte order mark. Raises `UndecodableError`."""
    wide = next((name for mark, name in _WIDE.items() if content.startswith(mark)), None)
    if wide is None and (found := _UNMARKED.match(content)) is not None:
        wide = "utf-16-le" if found[1] is None else "utf-16-be"
    if wide is not None:
        return _text(content, wide)
    declared = DECLARED.match(content)
    try:
        return _text(content, "utf-8-sig")
    except UndecodableError:
        if declared is None:
            raise
    name = declared[1].decode("ascii", "replace")
    try:
        return _text(content, name)
    except LookupError:
        before = content[: declared.start(1)].decode("ascii", "replace")
        raise UndecodableError(f"there is no encoding '{name}'", before) from None


def _text(content: bytes, encoding: str) -> str:
    try:
        return content.decode(encoding)
    except UnicodeDecodeError as error:
        before = content[: error.start].decode(encoding, "replace")
        name = encoding.removesuffix("-sig").upper()
        raise UndecodableError(f"this is not {name}: byte 0x{content[error.start]:02x}", before) from None
