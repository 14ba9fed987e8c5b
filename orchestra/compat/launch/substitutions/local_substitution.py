"""`LocalSubstitution`: what a context knows at one moment only."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.utilities.ensure_argument_type_impl import ensure_argument_type
from orchestra.compat.performed import PerformedSubstitution

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext


class LocalSubstitution(PerformedSubstitution):
    """A Python expression below `context.locals`, as `event.reason`. Raises `TypeError` for anything but a text."""

    _of_the_moment = True

    def __init__(self, expression: str, description: str | None = None) -> None:
        super().__init__()
        ensure_argument_type(expression, str, "expression", "LocalSubstitution")
        self.__expression = expression
        self.__description = description

    @property
    def expression(self) -> str:
        """The expression."""
        return self.__expression

    @property
    def description(self) -> str | None:
        """What it is, for people."""
        return self.__description

    def describe(self) -> str:
        """Return the expression, or what the user says of it."""
        return f"LocalVar('{self.expression if self.description is None else self.description}')"

    def perform(self, context: LaunchContext) -> Any:
        """Return what the expression gives, of whatever type. Raises `AttributeError`, and what the expression does."""
        return eval(f"context.locals.{self.expression}", {}, {"context": context})  # noqa: S307 - the user's own code
