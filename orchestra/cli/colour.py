"""When to colour, and with what."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TextIO, TypeAlias

Paint: TypeAlias = Callable[[str, str], str]

_STYLES = {
    "error": "1;31",
    "warning": "1;33",
    "note": "2",
    "help": "1;36",
    "strong": "1",
    "faint": "2",
}


def painter(*, enabled: bool) -> Paint:
    """Return a function from a style and a text to the painted text.

    Styles are `error`, `warning`, `note`, `help`, `strong` and `faint`.
    """
    if not enabled:
        return lambda _style, text: text
    return lambda style, text: f"\x1b[{_STYLES[style]}m{text}\x1b[0m" if text else text


def wanted(stream: TextIO, environment: Mapping[str, str]) -> bool:
    """Tell whether to colour a stream: NO_COLOR (no-color.org), then FORCE_COLOR, then whether it is a terminal."""
    if environment.get("NO_COLOR"):
        return False
    if environment.get("FORCE_COLOR", "0") not in ("", "0"):
        return True
    return stream.isatty() and environment.get("TERM") != "dumb"
