"""Substitutions without their end, where that is to be seen: `$(find-pkg-share demo/launch/a.launch.py`."""

from __future__ import annotations

from orchestra.patterns import pattern

# What takes one word, which ends before a slash or a point, or none at all.
_WHOLE = pattern(
    r"\$\( *(?:(?:dirname|filename)\b(?! *[\w)])"
    r"|(?:find-pkg-share|find-pkg-prefix|var|env|anon) +(?:[A-Za-z_]\w*)(?! *[\w\"'$(-]))"
)


def with_end(text: str, begin: int) -> tuple[int, str] | None:
    """Return where the substitution that begins at an offset was to end, and what it is with its ')'; else None."""
    found = _WHOLE.match(text, begin)
    return None if found is None else (found.end(), f"{found[0]})")
