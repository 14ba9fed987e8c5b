"""`for`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.amounts import UnfitError, made
from orchestra.resolve.context import Value
from orchestra.resolve.turns import carry_out

if TYPE_CHECKING:
    from orchestra.description.actions.for_loop import ForLoop
    from orchestra.resolve.resolution import Resolution


def visit(action: ForLoop, run: Resolution) -> None:
    """Visit the children so many times, with the index as a value of the turn."""
    length, name = made(action.len, _whole, run), run.text(action.name)
    if not isinstance(length, int) or not isinstance(name, str):
        carry_out(action, None, run)
        return
    at = run.at(action.name.span)
    carry_out(action, ({name: Value(str(index), at)} for index in range(length)), run)


def _whole(text: str) -> int:
    try:
        return int(text)
    except ValueError:
        raise UnfitError(f"expected a whole number, found '{text}'") from None
