"""`$(var name [default])`: a launch argument or variable."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.description.text import Words
from orchestra.errors import Code
from orchestra.location import is_python
from orchestra.nearest import nearest, one_slip
from orchestra.patterns import pattern
from orchestra.resolve.context import POISON, Value, new_value
from orchestra.resolve.refusals import refuse
from orchestra.resolve.substitutions.lookup import looked_up

if TYPE_CHECKING:
    from orchestra.description.text import Call, Template
    from orchestra.resolve.context import Context, Evaluated, Poison
    from orchestra.resolve.substitutions.arguments import Evaluate

# A default as shells and command lines give it.
_WITH_DEFAULT = pattern(r"(\w+)(?::[=-]|[=,:|])(\S+)")


def perform(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return the variable's value, else the default, which is evaluated only then."""
    at = context.at(call.span)
    written = call.arguments[0]
    name = written.parts[0] if len(written.parts) == 1 and not written.faulty else None
    if isinstance(name, Words):
        value = context.variables.get(name.text, at)
        if isinstance(value, Value):
            return new_value(value.text, at)
    found = looked_up(
        call,
        context,
        evaluate,
        find=lambda name: context.variables.get(name, at),
        report=_report,
    )
    if len(call.arguments) > 1 and isinstance(name, Words) and isinstance(found, Value):
        _check_default(name.text, written, context)
    return found


def _check_default(name: str, written: Template, context: Context) -> None:
    """Tell of a default that always counts, because the name of the variable is a slip for one that is set."""
    names = context.variables.names()
    if name in names or name in context.lost:
        return
    meant = one_slip(name, names)
    if meant is not None:
        told = f"nothing sets '{name}' here, so that its default counts"
        at = context.at(written.span)
        context.problems.warning(Code.UNDEFINED_VARIABLE, told, at, suggestion=meant)


def _report(name: str, written: Template, context: Context) -> Poison:
    if written.constant in context.lost:  # nothing is told of it: its slips need not be looked for
        return POISON
    names = context.variables.names()
    glued = _WITH_DEFAULT.fullmatch(name)
    is_glued = glued is not None and glued[1] in names
    meant = f"{glued[1]} {glued[2]}" if glued is not None and is_glued else nearest(name, names)
    if meant is None and getattr(context.variables, "left_open", False):
        return POISON
    told = f"no launch argument or variable {name!r} is set here"
    if name in getattr(context.variables, "outside", ()):
        meant, way = None, "launch_configurations" if is_python(written.span) else "`keep`"
        told += f": {way} of the group around it lets the one outside in"
    return refuse(written, context, Code.UNDEFINED_VARIABLE, told, meant=meant)
