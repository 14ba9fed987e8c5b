"""`$(param name [default])`: a parameter that `set_parameter` put in scope."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.substitutions.lookup import looked_up

if TYPE_CHECKING:
    from orchestra.description.text import Call
    from orchestra.resolve.context import Context, Evaluated
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
        code=Code.UNDEFINED_VARIABLE,
        told="no set_parameter has set {} here",
        known=lambda: context.parameters,
        kind="parameter",
    )
