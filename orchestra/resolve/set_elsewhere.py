"""Arguments and variables that are read where they are not set: where the description sets them is told with that."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.location import is_python

if TYPE_CHECKING:
    from orchestra.errors import Problem
    from orchestra.location import Location, Span
    from orchestra.resolve.resolution import Resolution

_UNSET: Final = re.compile(r"no launch argument or variable '([^']+)' is set here")


def tell_where_set(run: Resolution) -> None:
    """Add where it is declared or set, to each value that is told to be unset where it is read.

    Actions are visited in the order in which they stand: a declaration below counts only for what comes behind it.
    """
    run.problems.amend(lambda problem: _with_place(problem, run))


def _with_place(problem: Problem, run: Resolution) -> Problem:
    found = _UNSET.fullmatch(problem.message) if problem.code is Code.UNDEFINED_VARIABLE else None
    setting = None if found is None or problem.suggestion is not None else _setting(found[1], run)
    if setting is None or problem.span is None:
        return problem
    done, location = setting
    if _is_below(location.span, problem.span):
        told, note = " yet", f"it is {done} below, at {location}"
    else:
        told = ", only elsewhere"
        note = f"it is {done} at {location}, for what comes behind that in the same group"
    return replace(problem, message=problem.message + told, notes=(*problem.notes, note))


def _setting(name: str, run: Resolution) -> tuple[str, Location] | None:
    """Return what is done with a name somewhere, and where that is."""
    if (declared := run.found.arguments.get(name)) is not None:
        return "declared", declared.location
    return ("set", run.found.lets[name]) if name in run.found.lets else None


def _is_below(place: Span, read: Span) -> bool:
    """Return whether a place is below another in its file; where Python makes an action tells nothing of the order."""
    return (
        not is_python(place)
        and place.file == read.file
        and (place.line, place.column) > (read.line, read.column)
    )
