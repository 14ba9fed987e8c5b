"""`$(env name [default])`: an environment variable, as the description has set it up to here."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.refusals import report_unset_environment
from orchestra.resolve.substitutions.lookup import looked_up

if TYPE_CHECKING:
    from orchestra.description.text import Call
    from orchestra.resolve.context import Context, Evaluated
    from orchestra.resolve.substitutions.arguments import Evaluate


def perform(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return the environment variable's value, else the default, which is evaluated only then."""
    return looked_up(
        call,
        context,
        evaluate,
        find=context.environment.get,
        report=report_unset_environment,
        kind="environment",
    )
