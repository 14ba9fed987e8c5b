"""`PushEnvironment`."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from orchestra.description.actions.stacks import PushEnvironment
    from orchestra.resolve.resolution import Resolution


def visit(action: PushEnvironment, run: Resolution) -> None:
    """Save the environment."""
    del action
    run.scope.save_environment()
