"""Escape sequences and other bytes that mean something to a terminal."""

from __future__ import annotations

import re

# Select Graphic Rendition: colours and weights (ECMA-48, 8.3.117).
_STYLE = re.compile(r"\x1b\[[0-9;:]*m")
RESET = "\x1b[0m"
# Control functions of one byte but the tab; sequences of the forms CSI, OSC (to its terminator) and others (ECMA-48).
_SPECIAL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\udc80-\udcff]")
_CONTROL = re.compile(
    r"\x1b\[[0-?]*[ -/]*[@-~]"
    r"|\x1b[\]PX^_][^\x07\x1b]*(?:\x07|\x1b\\)"
    r"|\x1b[ -/]*[0-~]"
    r"|[\x00-\x08\x0b-\x1f\x7f-\x9f\udc80-\udcff]"
)

# Easy to tell from each other on dark and light ground; neighbours in a plan get neighbours here.
_COLOURS = (36, 33, 32, 35, 34, 96, 93, 92, 95, 94)


def plain(text: str) -> str:
    """Return the text without colours and weights."""
    return _STYLE.sub("", text) if "\x1b" in text else text


def coloured(text: str, index: int) -> str:
    """Return the text in the colour of the process with this index in the plan."""
    return f"\x1b[{_COLOURS[index % len(_COLOURS)]}m{text}{RESET}"


def for_screen(text: str) -> str:
    """Return output as it may stand behind a prefix.

    A line that was overwritten with carriage returns, as progress bars do, shows what it came to. A style that a line
    leaves switched on ends with it. Whatever else would move the cursor, ring, or change what the terminal does is
    left out, and bytes that are no text become question marks.
    """
    if not _SPECIAL.search(text):
        return text
    return "\n".join(_line_for_screen(line) for line in text.split("\n"))


def overwrites(text: str) -> bool:
    """Tell whether the first line of a piece of output begins anew what stands in its line already."""
    return "\r" in text.partition("\n")[0].rstrip("\r")


def _line_for_screen(line: str) -> str:
    shown = _CONTROL.sub(_harmless, line.rstrip("\r").rpartition("\r")[2])
    return shown + RESET if "\x1b" in shown else shown


def _harmless(found: re.Match[str]) -> str:
    sequence = found[0]
    if _STYLE.fullmatch(sequence):
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
