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


class RefusedError(Exception):
    """A text cannot be read at all; `fault` says why, `at` is the offset where its parser gave up."""

    def __init__(self, fault: Fault, at: int = 0) -> None:
        super().__init__(fault.message)
        self.fault, self.at = fault, at
