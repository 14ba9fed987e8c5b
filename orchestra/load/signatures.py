"""Compares how a substitution is written with what it takes."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Final

from orchestra.description.substitutions import SIGNATURES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.text import Template


_WITH_DEFAULT: Final = ("env", "param", "var")


@cache
def usage(name: str) -> str:
    """Return how the substitution is written, optional arguments in brackets."""
    signature = SIGNATURES[name]
    words = [
        argument.upper() if index < signature.minimum else f"[{argument.upper()}]"
        for index, argument in enumerate(signature.arguments)
    ]
    if signature.maximum is None:
        words.append("...")
    return f"$({' '.join([name, *words])})"


def lack(name: str, count: int) -> str | None:
    """Return what so many arguments lack, None where they are enough."""
    signature = SIGNATURES[name]
    return f"$({name}) lacks its {signature.arguments[count]}" if count < signature.minimum else None


def excess(name: str, count: int) -> str | None:
    """Return why so many arguments are too many, None where they are not."""
    match SIGNATURES[name].maximum:
        case None:
            return None
        case most if count <= most:
            return None
        case 0:
            return f"$({name}) takes no argument"
        case 1:
            return f"$({name}) takes one argument, not {count}"
        case most:
            return f"$({name}) takes at most {most} arguments, not {count}"


def one_default(name: str, arguments: Sequence[Template]) -> str | None:
    """Return the arguments of a name with several words for its default in quotes, None for any other substitution."""
    first, *rest = (argument.raw for argument in arguments)
    if name not in _WITH_DEFAULT or any(quote in word for word in rest for quote in "'\""):
        return None
    return f"{first} '{' '.join(rest)}'"
