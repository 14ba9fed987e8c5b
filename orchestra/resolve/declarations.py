"""Defaults that never count, and arguments that an include gives twice.

An argument that a file declares and never reads is no mistake: it belongs to what callers may rely on, and public
launch files are full of such.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.location import is_python
from orchestra.resolve.booleans import boolean
from orchestra.resolve.context import Value
from orchestra.resolve.mentions import glimpse

if TYPE_CHECKING:
    from collections.abc import Collection

    from orchestra.description.actions.arg import Arg
    from orchestra.location import Location
    from orchestra.resolve.resolution import Resolution


def declare(action: Arg, name: str, choices: Collection[str] | None, run: Resolution) -> None:
    """Report a default that never counts, because the file itself has given the variable another value before.

    One that is none of the `choices` is a mistake of its own. Code in Python may put lists of declarations together,
    of which the first counts.
    """
    variable = run.scope.variables.get(name)
    if variable is None or action.default is None:
        return
    before = variable.settled
    if before is None:
        return
    here = run.place(action.name)
    if before.span.file != here.span.file or before.included_from != here.included_from:
        return
    if (
        (is_python(here) and not _is_written_twice(here, name))
        or variable.leaked_from is not None
        or not isinstance(variable.value, Value)
    ):
        return
    default = glimpse(action.default, run.context, run.scope.variables)
    if default is None or (choices is not None and default.text not in choices):
        return
    known = run.found.arguments.get(name)
    if known is not None and known.default == action.default.raw:
        return  # whoever gives another value gives it for both
    if not _same(variable.value.text, default.text):
        message = f"the default of '{name}' never counts: it has a value before"
        run.problems.warning(Code.SHADOWED_ARGUMENT, message, here, notes=(f"it is set at {before}",))


def _is_written_twice(here: Location, name: str) -> bool:
    # Here, because few arguments are declared twice.
    from orchestra.compat.side_by_side import is_declared_twice  # noqa: PLC0415

    return is_declared_twice(os.path.abspath(here.span.file), name)  # noqa: PTH100 - no link is followed


def settle(name: str, at: Location, run: Resolution) -> None:
    """Note that a variable has a value from here on in this file, unless a condition stands on that."""
    if run.occasion is None and run.conditions + run.repetitions == run.frame.choices:
        run.scope.settle(name, at)


def check_twice(
    name: Value, value: object, given: dict[str, tuple[Location, object]], run: Resolution
) -> None:
    """Report an argument that an include gives twice; `given` are those before it."""
    before = given.get(name.text)
    if before is None or not isinstance(value, Value):
        return
    location, other = before
    if isinstance(other, Value) and other.text != value.text:
        message = f"'{name.text}' is given twice: this value counts"
        run.problems.warning(
            Code.SHADOWED_ARGUMENT, message, name.location, notes=(f"given first at {location}",)
        )


def _same(one: str, other: str) -> bool:
    return one == other or (boolean(one) is not None and boolean(one) == boolean(other))
