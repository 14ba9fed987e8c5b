"""`$(log_dir)` and `$(launch_log_dir)`: the log folder of the run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.substitutions.arguments import made

if TYPE_CHECKING:
    from orchestra.description.text import Call
    from orchestra.resolve.context import Context, Evaluated
    from orchestra.resolve.substitutions.arguments import Evaluate


def perform(call: Call, context: Context, _evaluate: Evaluate) -> Evaluated:
    """Return the folder, symbolic in a plan because it differs from run to run."""
    return made(call, context, context.log_folder)
