"""Values that begin with a '#', which YAML takes for a comment: `colour: #ff8800` says nothing of the colour."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.location import Span

EATEN: Final = ": what begins with '#' is a comment unless it is in quotes"
# One word, with nothing between it and the sign: a comment is several, or has a blank there.
_EATEN: Final = pattern(r"""["']?[ \t]*:?[ \t]+(#[^\s#'"\\]*[^\s#'"\\,}\]])[ \t,}\]]*$""")


def eaten(key: Span, lines: Sequence[str]) -> str | None:
    """Return in quotes the value behind a key, or behind the dash of an item, that is a comment; None without such.

    `lines` are those of the file.
    """
    line = lines[key.end_line - 1] if 0 < key.end_line <= len(lines) else ""
    found = _EATEN.match(line, key.end_column - 1)
    return None if found is None else f'"{found[1]}"'
