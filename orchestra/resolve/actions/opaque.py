"""What only the code of a Python launch file can carry out."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.python.visiting import visit_opaque

if TYPE_CHECKING:
    from orchestra.description.actions.opaque import OpaqueAction
    from orchestra.resolve.resolution import Resolution


def visit(action: OpaqueAction, run: Resolution) -> None:
    """Let the entity carry itself out, and visit what it returns."""
    visit_opaque(action, run)
