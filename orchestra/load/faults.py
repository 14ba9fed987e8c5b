"""What keeps a text from being read at all: the one thing that is wrong with it, in the words of who wrote it."""

from __future__ import annotations

from orchestra.dataclass import dataclass
from orchestra.errors import Code
from orchestra.location import Span


@dataclass(frozen=True, slots=True)
class Fault:
    """What is wrong and where."""

    message: str
    span: Span
    code: Code = Code.SYNTAX
    suggestion: str | None = None
    notes: tuple[str, ...] = ()
