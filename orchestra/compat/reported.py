"""What stops user code in silence."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from orchestra.errors import Problem

CARRYING: Final = "__carrying_on__"  # the name in a module of what goes on behind its mistakes


class ReportedError(RuntimeError):
    """Stops user code for a fault that has been reported, or will be with `problems`."""

    def __init__(self, message: str, problems: tuple[Problem, ...] = ()) -> None:
        super().__init__(message)
        self.problems = problems
