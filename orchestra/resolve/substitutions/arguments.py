"""What the substitutions share: how their arguments are evaluated and how their results are made.

Evaluating an argument may perform further substitutions. So that imports stay free of cycles, the evaluation is
handed to each substitution instead of being imported by it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from orchestra.description.text import Call, Template
from orchestra.errors import Code
from orchestra.location import Span
from orchestra.resolve.booleans import boolean
from orchestra.resolve.context import Context, Evaluated, Poison, Value, new_value
from orchestra.resolve.refusals import refuse

Evaluate: TypeAlias = Callable[[Template, Context], Evaluated]
Substitution: TypeAlias = Callable[[Call, Context, Evaluate], Evaluated]


def texts(call: Call, context: Context, evaluate: Evaluate) -> tuple[str, ...] | None:
    """Evaluate all arguments; None where one is poison, after the others have had their faults reported."""
    values = [evaluate(argument, context) for argument in call.arguments]
    found = tuple(value.text for value in values if isinstance(value, Value))
    return found if len(found) == len(values) else None


def span_of_arguments(call: Call) -> Span:
    """Return the place of all arguments together."""
    first, last = call.arguments[0].span, call.arguments[-1].span
    return Span(first.file, first.line, first.column, last.end_line, last.end_column)


def made(call: Call, context: Context, text: str) -> Value:
    """Return the result of a substitution, which points at where the substitution is written."""
    return new_value(text, context.at(call.span))


def truth(flag: bool) -> str:
    """Return how a boolean result is written."""
    return "true" if flag else "false"


def booleans(call: Call, context: Context, evaluate: Evaluate) -> tuple[bool, ...] | None:
    """Evaluate all arguments as booleans; None where one is poison or, which is reported, not a boolean."""
    flags = [boolean_argument(argument, context, evaluate) for argument in call.arguments]
    found = tuple(flag for flag in flags if flag is not None)
    return found if len(found) == len(flags) else None


def boolean_argument(argument: Template, context: Context, evaluate: Evaluate) -> bool | None:
    """Evaluate one argument as a boolean; None where it is poison or, which is reported, not a boolean."""
    value = evaluate(argument, context)
    if isinstance(value, Poison):
        return None
    flag = boolean(value.text)
    if flag is None:
        refuse(argument, context, Code.BAD_VALUE, f"{value.text!r} is not a boolean: write true or false")
    return flag
