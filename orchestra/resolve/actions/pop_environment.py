"""`PopEnvironment`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code

if TYPE_CHECKING:
    from orchestra.description.actions.stacks import PopEnvironment
    from orchestra.resolve.resolution import Resolution


def visit(action: PopEnvironment, run: Resolution) -> None:
    """Restore the environment that was saved last in this scope."""
    if not run.scope.saved_environments:
        run.problems.error(Code.BAD_VALUE, "no environment has been pushed here", run.at(action.span))
        return
    run.scope.restore_environment(run.scope.saved_environments.pop())
