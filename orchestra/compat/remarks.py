"""Warnings of what code of a launch file does, while it runs: code goes on."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.refusing import collector
from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.location import Location

if TYPE_CHECKING:
    from orchestra.compat.place import Place
    from orchestra.errors import Problem
    from orchestra.location import Span


def remark_of_value(message: str, value: Any, place: Place, argument: str) -> None:
    """Warn of the value of an argument, which can be made use of all the same."""
    if collector() is None:
        return
    # Here, because only mistakes need them, and what they import.
    from orchestra.compat.literals import keyword  # noqa: PLC0415
    from orchestra.compat.rewritten import rewritten  # noqa: PLC0415

    span = keyword(place, argument).whole
    meant = None if span == place.span else rewritten(place.file, span, value, message)
    remark(Code.WRONG_TYPE, message, span, suggestion=meant)


def report(problem: Problem) -> None:
    """Report a problem with the includes on the way to the code that runs."""
    collecting = collector()
    if collecting is not None:
        problems, chain = collecting
        problems.report(replace(problem, included_from=chain))


def remark(
    code: Code, message: str, span: Span, *, suggestion: str | None = None, notes: tuple[str, ...] = ()
) -> None:
    """Warn of something at a place, once; not where nobody collects problems."""
    collecting = collector()
    if collecting is None:
        return
    problems, chain = collecting
    if all(problem.span != span or problem.code is not code for problem in problems):
        problems.warning(code, message, Location(span, chain), suggestion=suggestion, notes=notes)
