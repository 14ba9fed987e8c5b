"""`PopLaunchConfigurations`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code

if TYPE_CHECKING:
    from orchestra.description.actions.stacks import PopLaunchConfigurations
    from orchestra.resolve.resolution import Resolution


def visit(action: PopLaunchConfigurations, run: Resolution) -> None:
    """Restore what was saved last in this scope."""
    if not run.scope.saved_settings:
        message = "no launch configurations have been pushed here"
        run.problems.error(Code.BAD_VALUE, message, run.at(action.span))
        return
    run.scope.restore_settings(run.scope.saved_settings.pop())
