"""`unset_env`."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from orchestra.description.actions.unset_env import UnsetEnv
    from orchestra.resolve.resolution import Resolution


def visit(action: UnsetEnv, run: Resolution) -> None:
    """Remove an environment variable for what follows."""
    name = run.text(action.name)
    if isinstance(name, str):
        run.scope.change(name, None, run.at(action.span))
