"""`launch.Condition`: whether an action is carried out."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.described import said
from orchestra.compat.refusing import Refusing
from orchestra.description.text import Opaque, Template

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.location import Span


class Condition(Refusing):
    """A predicate on the context; without one it never holds. Users derive from it or hand a callable in."""

    def __init__(self, *, predicate: Callable[[LaunchContext], bool] | None = None) -> None:
        self._predicate = predicate

    def describe(self) -> str:
        """Return what the condition is."""
        return self.__repr__()

    def evaluate(self, context: LaunchContext) -> bool:
        """Return whether it holds."""
        return self._predicate is not None and self._predicate(context)

    def _fields(self, span: Span) -> dict[str, Any]:
        """Return the field of a model that says the same: `if` or `unless` with a template."""
        return {"if": Template((Opaque(_Holding(self), span),), said(self, Condition), span)}


class _Holding:
    """Performs a condition as a substitution that comes to `true` or `false`."""

    def __init__(self, condition: Condition) -> None:
        self._condition = condition

    def perform(self, context: LaunchContext) -> str:
        """Return whether the condition holds."""
        return "true" if self._condition.evaluate(context) else "false"
