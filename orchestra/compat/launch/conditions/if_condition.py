"""`IfCondition`: holds where a text comes to true."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.calls import CallSubstitution, own
from orchestra.compat.described import described
from orchestra.compat.launch.condition import Condition
from orchestra.compat.place import IN_CONSTRUCTOR, here
from orchestra.compat.text import normalized, template

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub
    from orchestra.location import Span


class IfCondition(Condition):
    """Holds where the substitutions come to true. Raises `TypeError` for a boolean of Python: that is no condition."""

    _field = "if"
    _wanted = True
    __expression: list[Substitution] = own()

    def __init__(self, predicate_expression: Sub) -> None:
        self.__expression = normalized(predicate_expression)
        self._place = here(self, IN_CONSTRUCTOR)
        self._predicate = self._predicate_func

    def _keep(self, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> bool:
        if keywords or len(arguments) != 1 or not isinstance(arguments[0], CallSubstitution):
            return False
        self._as_given = arguments, keywords
        return True

    def describe(self) -> str:
        """Return the text and what becomes of it."""
        return f"{type(self).__name__}({described(self.__expression)})"

    def _predicate_func(self, context: LaunchContext) -> bool:
        """Return whether the condition holds; files call this by upstream's name for it."""
        # Here, because only code that asks for it needs it: a visit goes by the text.
        from orchestra.compat.launch.conditions.evaluate_condition_expression_impl import (  # noqa: PLC0415
            evaluate_condition_expression,
        )

        return evaluate_condition_expression(context, self.__expression) is self._wanted

    def _fields(self, span: Span) -> dict[str, Any]:
        kind = type(self)
        if kind.evaluate is not _evaluate or kind._predicate_func is not _judge:  # of a user's
            return super()._fields(span)
        given = self._as_given
        expression = self.__expression if given is None else given[0]
        whole = expression[0]._whole() if len(expression) == 1 else None
        if whole is None:
            whole = template(expression, self._place.at("predicate_expression"))
        return {self._field: whole}


_evaluate: Final = Condition.evaluate
_judge: Final = IfCondition._predicate_func
