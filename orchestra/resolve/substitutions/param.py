"""`$(param name [default])`: a parameter that `set_parameter` put in scope."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.location import Span, is_python
from orchestra.nearest import nearest
from orchestra.resolve.context import POISON
from orchestra.resolve.refusals import refuse
from orchestra.resolve.substitutions.lookup import looked_up

if TYPE_CHECKING:
    from orchestra.description.text import Call, Template
    from orchestra.resolve.context import Context, Evaluated, Poison
    from orchestra.resolve.substitutions.arguments import Evaluate


def perform(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return the parameter's value, else the default, which is evaluated only then.

    Of several the last one counts. As upstream, parameters of a node and of parameter files are not looked at.
    """
    return looked_up(
        call,
        context,
        evaluate,
        find=context.parameters.get,
        report=partial(_report, call),
        kind="parameter",
    )


def _report(call: Call, name: str, written: Template, context: Context) -> Poison:
    """Report a name that no action has set; where it is that of a variable, the substitution is the wrong one."""
    told = f"no set_parameter has set {name!r} here"
    span = call.span
    if name in context.variables.names() and not is_python(span) and span.line == span.end_line:
        begin = span.column + len("$(")
        at = Span(span.file, span.line, begin, span.line, begin + len(call.name))
        told += f": '{name}' is a launch argument or variable"
        context.problems.error(Code.UNDEFINED_VARIABLE, told, context.at(at), suggestion="var")
        return POISON
    return refuse(written, context, Code.UNDEFINED_VARIABLE, told, meant=nearest(name, context.parameters))
