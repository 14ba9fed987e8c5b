"""Substitutions in other brackets than round ones: `${var name}`, which stays the text that it is."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.description.substitutions import ELSEWHERE, SIGNATURES
from orchestra.errors import Code
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.errors import Problems
    from orchestra.location import Span

_OLD: Final = ("arg", "find", "optenv")  # those of ROS 1
# With an argument: a name alone, as `${HOME}`, is for a shell.
_BRACED = pattern(r"\$(?:\{([a-z][a-z-]*)(\s[^{}()\[\]]*)\}|\[([a-z][a-z-]*)(\s[^{}()\[\]]*)\])")


def report_braces(text: str, spans: Callable[[int, int], Span], problems: Problems) -> bool:
    """Report substitutions that are none for the sake of their brackets; return whether there are such."""
    before = len(problems)
    for found in _BRACED.finditer(text):
        name, arguments = found[1] or found[3], found[2] or found[4]
        if name in SIGNATURES or name in _OLD:
            message = f"{found[0]} is no substitution: those are in round brackets"
            meant = f"$({ELSEWHERE.get(name, name)}{arguments})"
            problems.error(Code.SUBSTITUTION_SYNTAX, message, spans(*found.span()), suggestion=meant)
    return len(problems) > before
