"""`$(param name [default])`: a parameter that `set_parameter` put in scope."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.nearest import nearest
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
        report=_report,
        kind="parameter",
    )


def _report(name: str, written: Template, context: Context) -> Poison:
    told = f"no set_parameter has set {name!r} here"
    return refuse(written, context, Code.UNDEFINED_VARIABLE, told, meant=nearest(name, context.parameters))
