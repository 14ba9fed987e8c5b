"""How the text of a condition is read."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.launch.conditions.invalid_condition_expression_error import (
    InvalidConditionExpressionError,
)
from orchestra.compat.launch.utilities.perform_substitutions_impl import perform_substitutions
from orchestra.description.fields import FALSE_WORDS, TRUE_WORDS

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.substitution import Substitution


def evaluate_condition_expression(context: LaunchContext, expression: Iterable[Substitution]) -> bool:
    """Return the boolean that substitutions come to, spaces around it ignored.

    `yes`, `no`, `on` and `off` are welcome too, as everywhere else. Raises `InvalidConditionExpressionError` for
    anything that is no boolean.
    """
    text = perform_substitutions(context, expression)
    word = text.strip().lower()
    if word not in TRUE_WORDS | FALSE_WORDS:
        raise InvalidConditionExpressionError(f"a condition comes to true or false, not {text!r}")
    return word in TRUE_WORDS
