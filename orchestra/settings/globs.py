"""Patterns of paths as `.gitignore` has them (git-scm.com/docs/gitignore), also for the settings of a project."""

from __future__ import annotations

import re
from functools import lru_cache

from orchestra.dataclass import dataclass

_PIECES = re.compile(r"\*\*/|/\*\*$|\*|\?|\[!?[^\]/]+\]|\\?.", re.DOTALL)


@dataclass(frozen=True, slots=True)
class Pattern:
    """`negated` takes back what an earlier pattern said; `folders` alone are meant by one that ends in a slash."""

    expression: re.Pattern[str]
    negated: bool = False
    folders: bool = False

    def matches(self, path: str, *, folder: bool) -> bool:
        """Tell whether a path is meant; it is relative to where the pattern stands, with `/`."""
        return (folder or not self.folders) and self.expression.fullmatch(path) is not None


@lru_cache(maxsize=1024)
def pattern(text: str) -> Pattern:
    """Return what a pattern means: without a slash inside it is a name at any depth, else a path from its place."""
    negated = text.startswith("!")
    body = text[negated:].removeprefix("\\") if text.startswith(("!", "\\#", "\\!")) else text
    folders, body = body.endswith("/"), body.rstrip("/")
    anchored = "/" in body
    pieces = "".join(_translated(found.group()) for found in _PIECES.finditer(body.removeprefix("/")))
    return Pattern(re.compile(pieces if anchored else f"(?:.*/)?{pieces}", re.DOTALL), negated, folders)


def patterns(text: str) -> tuple[Pattern, ...]:
    """Return the patterns in the text of a `.gitignore`."""
    lines = (line.rstrip() for line in text.splitlines())
    return tuple(pattern(line) for line in lines if line.strip("/!") and not line.startswith("#"))


def ignored(path: str, among: tuple[Pattern, ...], *, folder: bool) -> bool | None:
    """Tell what the last pattern that matches says of a path, None where none does."""
    for item in reversed(among):
        if item.matches(path, folder=folder):
            return not item.negated
    return None


def covers(text: str, path: str) -> bool:
    """Tell whether a pattern means a file or a folder above it."""
    parts = path.split("/")
    return any(
        pattern(text).matches("/".join(parts[:length]), folder=length < len(parts))
        for length in range(1, len(parts) + 1)
    )


def _translated(piece: str) -> str:
    if piece == "**/":
        return "(?:.*/)?"
    if piece == "/**":
        return "/.*"
    if piece == "*":
        return "[^/]*"
    if piece == "?":
        return "[^/]"
    if piece.startswith("[") and piece.endswith("]"):
        return piece.replace("[!", "[^", 1).replace("\\", "\\\\")
    return re.escape(piece.removeprefix("\\") or "\\")
