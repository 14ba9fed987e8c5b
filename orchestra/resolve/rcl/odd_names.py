"""Names of parameters that no node declares: with a '/' before them, with blanks."""

from __future__ import annotations

from typing import Final

from orchestra.patterns import pattern

_BLANKS: Final = pattern(r"\s*\w+(?:\s+\w+)*\s*")


def may_be_odd(name: str) -> bool:
    """Return whether a name takes a closer look."""
    return name[:1] == "/" or " " in name


def odd_name(name: str) -> tuple[str, str] | None:
    """Return what is to be told of a name that no node declares, and the one that was meant; None for any other."""
    if name[:1] == "/" and name.strip("/"):
        return "names of parameters begin with no '/'", name.lstrip("/")
    if " " in name and _BLANKS.fullmatch(name):
        return "names of parameters have no blanks", "_".join(name.split())
    return None
