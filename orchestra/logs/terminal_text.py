"""Escape sequences and other bytes that mean something to a terminal.

Expressions are compiled by `re` when they are first wanted: most runs want none of them before their first process.
"""

from __future__ import annotations

import re
from typing import Final

# Select Graphic Rendition: colours and weights (ECMA-48, 8.3.117).
_STYLE: Final = r"\x1b\[[0-9;:]*m"
_STYLE_BYTES: Final = _STYLE.encode()
RESET = "\x1b[0m"
# Control functions of one byte but the tab; sequences of the forms CSI, OSC (to its terminator) and others (ECMA-48).
_CONTROL: Final = (
    r"\x1b\[[0-?]*[ -/]*[@-~]"
    r"|\x1b[\]PX^_][^\x07\x1b]*(?:\x07|\x1b\\)"
    r"|\x1b[ -/]*[0-~]"
    r"|[\x00-\x08\x0b-\x1f\x7f-\x9f\udc80-\udcff]"
)
# The same of one byte. In a long text each is looked for by itself: thirty searches for one byte are then faster than
# one for any of thirty.
_SPECIAL: Final = bytes((*range(0x09), *range(0x0B, 0x20), 0x7F))
_LONG: Final = 2048
# U+0080 to U+009F in UTF-8.
_SPECIAL_CHARACTER: Final = rb"\xc2[\x80-\x9f]"
_STYLE_ENDED: Final = RESET.encode()

# Easy to tell from each other on dark and light ground; neighbours in a plan get neighbours here.
_COLOURS = (36, 33, 32, 35, 34, 96, 93, 92, 95, 94)


def plain(data: bytes) -> bytes:
    """Return output without colours and weights."""
    return re.sub(_STYLE_BYTES, b"", data) if b"\x1b" in data else data


def plain_text(text: str) -> str:
    """Return text without colours and weights."""
    return re.sub(_STYLE, "", text) if "\x1b" in text else text


def harmless(data: bytes) -> bool:
    """Tell whether output is text in which nothing but ends of lines and tabs means something to a terminal."""
    if len(data) < _LONG:
        special = len(data.translate(None, _SPECIAL)) < len(data)
    else:
        special = any(map(data.__contains__, _SPECIAL))
    if special:
        return False
    if data.isascii():
        return True
    try:
        data.decode()
    except UnicodeDecodeError:
        return False
    return not re.search(_SPECIAL_CHARACTER, data)


def coloured(text: str, index: int) -> str:
    """Return the text in the colour of the process with this index in the plan."""
    return f"\x1b[{_COLOURS[index % len(_COLOURS)]}m{text}{RESET}"


def for_screen(data: bytes, *, clean: bool) -> bytes:
    """Return output as it may stand behind a prefix; `clean` says that without colours it is harmless.

    A line that was overwritten with carriage returns, as progress bars do, shows what it came to. A style that a line
    leaves switched on ends with it. Whatever else would move the cursor, ring, or change what the terminal does is
    left out, and bytes that are no text become question marks.
    """
    if clean:
        return _with_styles_ended(data) if b"\x1b" in data else data
    lines = data.decode("utf-8", "surrogateescape").split("\n")
    return "\n".join(map(_line_for_screen, lines)).encode()


def _with_styles_ended(data: bytes) -> bytes:
    return b"\n".join([line + _STYLE_ENDED if b"\x1b" in line else line for line in data.split(b"\n")])


def overwrites(data: bytes) -> bool:
    """Tell whether the first line of a piece of output begins anew what stands in its line already."""
    return b"\r" in data and b"\r" in data.partition(b"\n")[0].rstrip(b"\r")


def _line_for_screen(line: str) -> str:
    shown = re.sub(_CONTROL, _harmless_control, line.rstrip("\r").rpartition("\r")[2])
    return shown + RESET if "\x1b" in shown else shown


def _harmless_control(found: re.Match[str]) -> str:
    sequence = found[0]
    if re.fullmatch(_STYLE, sequence):
        return sequence
    return "?" if len(sequence) == 1 else ""


def wants_colour(*, asked: bool | None, terminal: bool, environment: dict[str, str]) -> bool:
    """Decide about colour: what was asked for, else NO_COLOR (no-color.org), else FORCE_COLOR, else on a terminal."""
    if asked is not None:
        return asked
    if environment.get("NO_COLOR"):
        return False
    if environment.get("FORCE_COLOR"):
        return environment["FORCE_COLOR"] != "0"
    return terminal and environment.get("TERM") != "dumb"
