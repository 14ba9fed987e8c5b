"""`PushLaunchConfigurations`."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from orchestra.description.actions.stacks import PushLaunchConfigurations
    from orchestra.resolve.resolution import Resolution


def visit(action: PushLaunchConfigurations, run: Resolution) -> None:
    """Save variables, and what is set for all nodes."""
    del action
    run.scope.save_settings()
