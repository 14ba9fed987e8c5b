"""What an exception of user code means, where the names that launch files use are known better than to Python."""

from __future__ import annotations

from typing import Any, Final

from orchestra.dataclass import dataclass
from orchestra.errors import Code, Severity
from orchestra.location import Span
from orchestra.patterns import pattern

_ROOM: Final = pattern(r"\borchestra\.compat\.(?=\w)")
_OBJECT: Final = pattern(r"<(?:function )?(?:[\w<>]+\.)*([\w<>]+?)(?: object)? at 0x[0-9a-f]+>")
_LOCAL: Final = pattern(r"\b(?:\w+\.(?:<locals>\.)?)*<locals>\.")
_INSTALLED: Final = pattern(r" \((?:/|unknown location)[^)]*\)$")


@dataclass(frozen=True, slots=True)
class Explanation:
    """What is wrong: `span` where it is narrower than the line, `suggestion` what should stand there."""

    message: str
    code: Code = Code.USER_CODE
    span: Span | None = None
    suggestion: str | None = None
    notes: tuple[str, ...] = ()
    severity: Severity = Severity.ERROR


def in_their_words(text: str) -> str:
    """Return a message with the names that launch files use, without where objects and modules happen to be."""
    return _OBJECT.sub(r"<\1>", _LOCAL.sub("", _ROOM.sub("", _INSTALLED.sub("", text))))


def told(value: Any) -> str:
    """Return what a value is, for a message that says what was expected instead."""
    if value is None:
        return "None"
    if isinstance(value, type):
        return f"the class {value.__name__}"
    if isinstance(value, str | bytes | bool | int | float):
        return repr(value)
    if callable(value) and hasattr(value, "__name__"):
        return f"the function {value.__name__}"
    name = type(value).__name__
    return f"{'an' if name[0] in 'AEIOUaeiou' else 'a'} {name}"
