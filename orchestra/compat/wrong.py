"""What is raised for a value that an argument cannot have, where more is known of it than that.

Each is of the kind that upstream raises, for code that catches it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.errors import Code

if TYPE_CHECKING:
    from orchestra.compat.place import Step
    from orchestra.location import Span


class WrongValue(Exception):
    """The root: `value` is what was given, `suggestion` what was meant, where that is known.

    `path` is where it stands among the arguments, `at` the place itself, for what is found out after the call.
    """

    def __init__(
        self,
        message: str,
        value: Any = None,
        *,
        code: Code = Code.WRONG_TYPE,
        path: tuple[Step, ...] = (),
        at: Span | None = None,
        suggestion: str | None = None,
    ) -> None:
        super().__init__(message)
        self.code = code
        self.value = value
        self.path = path
        self.at = at
        self.suggestion = suggestion


class WrongType(WrongValue, TypeError):
    """Where upstream raises `TypeError`."""


class WrongNumber(WrongValue, ValueError):
    """Where upstream raises `ValueError`."""


class WrongRuntime(WrongValue, RuntimeError):
    """Where upstream raises `RuntimeError`."""
