"""`reset`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.kept import kept
from orchestra.resolve.scope import SavedSettings

if TYPE_CHECKING:
    from orchestra.description.actions.reset import Reset
    from orchestra.resolve.resolution import Resolution


def visit(action: Reset, run: Resolution) -> None:
    """Forget what is set but for the environment; what is kept is evaluated before."""
    keep = kept(action.keep, run)
    run.scope.restore_settings(SavedSettings())
    for name, value, location in keep:
        run.scope.set(name, value, location)
