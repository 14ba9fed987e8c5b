"""What may be told of conditions that differ by numbers alone, found out once for all of them.

Of most there is nothing to tell whatever their numbers are, unless one of their variables has choices.
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Final

from orchestra.patterns import pattern
from orchestra.resolve.formulas.formula import formula_of

if TYPE_CHECKING:
    import ast
    from collections.abc import Iterator

    from orchestra.description.calculated import Calculated
    from orchestra.description.substitutions import Part, Shape
    from orchestra.resolve.resolution import Resolution

_COMPARISONS: Final = ("equals", "not-equals")
# What there may be to tell.
_NOTHING, _OF_CHOICES, _ANYTHING = range(3)
_MARK: Final = "\ue000"  # what is substituted in an expression
_TEXT: Final = pattern(r"""'[^'\\\n]*'|"[^"\\\n]*\"""")
_OF_TEXTS: Final = ("T==T", "T!=T")
_OF_NUMBERS: Final = frozenset("0.=!<>")


def may_be_told(calculation: Calculated, run: Resolution) -> bool:
    """Return whether a comparison in a condition may come always to the same."""
    formula = formula_of(calculation)
    if formula.telling is None:
        formula.telling = max(map(_telling, _outside(formula.shape)), default=_NOTHING)
    if formula.telling != _OF_CHOICES or calculation.names is None:
        return formula.telling != _NOTHING
    return bool(run.found.choices) and any(
        run.found.choices_of(name) is not None for name in calculation.names
    )


def may_be_bare(calculation: Calculated) -> bool:
    """Return whether a comparison in a condition may be one of constants alone, or have a comma in it."""
    formula = formula_of(calculation)
    if formula.bare is None:
        formula.bare = any(
            call.text in _COMPARISONS and (_is_constant(call) or formula.shape.raw.find(",") >= 0)
            for call in _calls(formula.shape)
        )
    return formula.bare


def _is_constant(call: Part) -> bool:
    return all(part.arguments is None for argument in call.arguments or () for part in argument.parts)


def _calls(shape: Shape) -> Iterator[Part]:
    """Yield every call in a text."""
    for part in shape.parts:
        if part.arguments is not None:
            yield part
            for argument in part.arguments:
                yield from _calls(argument)


def _outside(shape: Shape) -> Iterator[Part]:
    """Yield the calls in a text, those in expressions left out."""
    for part in shape.parts:
        if part.arguments is not None:
            yield part
            for argument in () if part.text == "eval" else part.arguments:
                yield from _outside(argument)


def _telling(call: Part) -> int:
    if call.text in _COMPARISONS:
        return _OF_CHOICES
    return _telling_of_expression(call.arguments[0]) if call.text == "eval" and call.arguments else _NOTHING


def _telling_of_expression(shape: Shape) -> int:
    text = "".join([part.text if part.arguments is None else _MARK for part in shape.parts]).strip()
    if _MARK not in text or not any(word in text for word in ("==", "!=", "in")):
        return _NOTHING
    clauses = _TEXT.sub("T", text).replace(" ", "").replace("or", "and").split("and")
    if all(clause in _OF_TEXTS or _OF_NUMBERS.issuperset(clause) for clause in clauses):
        return _OF_CHOICES  # of texts and of numbers, as most of them are
    import ast  # noqa: PLC0415 - slow, and few conditions are other expressions

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text, mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return _ANYTHING if "\\" in text else _NOTHING  # `\x41` is none with 0 for its number
    compared = [node for node in ast.walk(tree) if isinstance(node, ast.Compare) and len(node.ops) == 1]
    return max(map(_telling_of, compared), default=_NOTHING)


def _telling_of(node: ast.Compare) -> int:
    import ast  # noqa: PLC0415 - as above

    (operator,), (right,) = node.ops, node.comparators
    sides = [node.left, right]
    if isinstance(operator, ast.In | ast.NotIn) and isinstance(right, ast.Tuple | ast.List | ast.Set):
        sides = [node.left, *right.elts]
    elif not isinstance(operator, ast.Eq | ast.NotEq):
        return _NOTHING
    values = [side.value for side in sides if isinstance(side, ast.Constant)]
    if len(values) < len(sides) or not any(isinstance(value, str) and _MARK in value for value in values):
        return _NOTHING
    return _OF_CHOICES if all(isinstance(value, str) for value in values) else _ANYTHING
