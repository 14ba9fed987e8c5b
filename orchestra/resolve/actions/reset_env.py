"""`reset_env`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.scope import SavedEnvironment

if TYPE_CHECKING:
    from orchestra.description.actions.reset_env import ResetEnv
    from orchestra.resolve.resolution import Resolution


def visit(action: ResetEnv, run: Resolution) -> None:
    """Make the environment what it was when the launch began."""
    del action
    run.scope.restore_environment(SavedEnvironment(dict(run.inputs.environment)))
