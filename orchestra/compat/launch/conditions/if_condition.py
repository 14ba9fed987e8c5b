"""`IfCondition`: holds where a text comes to true."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.described import described
from orchestra.compat.launch.condition import Condition
from orchestra.compat.launch.conditions.evaluate_condition_expression_impl import (
    evaluate_condition_expression,
)
from orchestra.compat.place import here
from orchestra.compat.text import normalized, template

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.text import Sub
    from orchestra.location import Span


class IfCondition(Condition):
    """Holds where the substitutions come to true. Raises `TypeError` for a boolean of Python: that is no condition."""

    _field = "if"
    _wanted = True

    def __init__(self, predicate_expression: Sub) -> None:
        self.__expression = normalized(predicate_expression)
        self._place = here(self)
        super().__init__(predicate=self._predicate_func)

    def describe(self) -> str:
        """Return the text and what becomes of it."""
        return f"{type(self).__name__}({described(self.__expression)})"

    def _predicate_func(self, context: LaunchContext) -> bool:
        """Return whether the condition holds; files call this by upstream's name for it."""
        return evaluate_condition_expression(context, self.__expression) is self._wanted

    def _fields(self, span: Span) -> dict[str, Any]:
        judging: tuple[Any, ...] = (type(self).evaluate, type(self)._predicate_func)
        if not all(method.__module__.startswith("orchestra.compat.") for method in judging):
            return super()._fields(span)
        return {self._field: template(self.__expression, self._place.at("predicate_expression"))}
