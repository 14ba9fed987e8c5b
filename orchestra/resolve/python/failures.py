"""What user code sees raised where something that it asked for cannot be: the same kinds as upstream.

Each carries `problems`, which nobody knows yet: they are reported where the exception leaves the user's code.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.ament_index_python.packages import PackageNotFoundError
from orchestra.compat.launch.conditions.invalid_condition_expression_error import (
    InvalidConditionExpressionError,
)
from orchestra.compat.launch.substitutions.substitution_failure import SubstitutionFailure
from orchestra.errors import Code

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.errors import Problem, Problems

_OF_TEXTS: Final[dict[Code | None, type[Exception]]] = {Code.MISSING_PACKAGE: PackageNotFoundError}
_OF_THIS_HOST: Final = (Code.MISSING_PACKAGE, Code.MISSING_EXECUTABLE, Code.UNSET_ENVIRONMENT)
_KINDS: Final[dict[Code | None, type[Exception]]] = {
    Code.BAD_CONDITION: InvalidConditionExpressionError,
    Code.MISSING_FILE: FileNotFoundError,
    **_OF_TEXTS,
    Code.BAD_EXPRESSION: SubstitutionFailure,
    Code.COMMAND_FAILED: SubstitutionFailure,
    Code.MISSING_EXECUTABLE: SubstitutionFailure,
    Code.NO_CURRENT_FILE: SubstitutionFailure,
    Code.UNDEFINED_VARIABLE: SubstitutionFailure,
    Code.UNSET_ENVIRONMENT: SubstitutionFailure,
}


def failure(problems: Iterable[Problem]) -> Exception | None:
    """Return what is to be raised for problems, None where there are none."""
    told = tuple(problems)
    return _carrying(_KINDS.get(told[0].code, RuntimeError), told) if told else None


def unevaluated(found: Problems) -> Exception:
    """Return what is to be raised where a text comes to nothing, for a fault that is known already if not for these.

    A package, a program or a variable that is not on this host is one, for code cannot go on without it; as elsewhere,
    it may only be a warning where it is reported.
    """
    missing = (problem for problem in found if problem.code in _OF_THIS_HOST)
    told = found.errors or tuple(missing)
    return _carrying(_OF_TEXTS.get(told[0].code if told else None, SubstitutionFailure), told)


def _carrying(kind: type[Exception], problems: tuple[Problem, ...]) -> Exception:
    told = [(problem.message, *problem.notes) for problem in problems[:1]]
    error: Any = kind("\n".join(told[0]) if told else "a value has a fault that is reported")
    error.problems = problems
    made: Exception = error
    return made
