"""`UnsetLaunchConfiguration`."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from orchestra.description.actions.unset_let import UnsetLet
    from orchestra.resolve.resolution import Resolution


def visit(action: UnsetLet, run: Resolution) -> None:
    """Unset a variable; one that is not set stays so."""
    name = run.text(action.name)
    if isinstance(name, str):
        run.scope.forget(name)
