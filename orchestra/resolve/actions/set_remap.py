"""`set_remap`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.bounded import with_rule
from orchestra.resolve.remapping import remap

if TYPE_CHECKING:
    from orchestra.description.actions.set_remap import SetRemap
    from orchestra.resolve.resolution import Resolution


def visit(action: SetRemap, run: Resolution) -> None:
    """Add a rule for every node that follows."""
    rule = remap(action.from_, action.to, run)
    if rule is not None:
        run.scope.remaps = with_rule(run.scope.remaps, rule)
