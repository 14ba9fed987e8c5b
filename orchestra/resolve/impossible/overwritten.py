"""Arguments that a file overwrites before anything reads them: whoever gives a value for one gives it in vain."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.description.actions.arg import Arg
from orchestra.errors import Code
from orchestra.resolve.mentions import names_in

if TYPE_CHECKING:
    from orchestra.description.actions.let import Let
    from orchestra.resolve.context import Value
    from orchestra.resolve.resolution import Resolution


def check_overwritten(action: Let, name: Value, run: Resolution) -> None:
    """Tell of a variable that is set in any case, of an argument that the same file declares and nothing has read.

    One that is set in a group, or where a condition says so, may be what the file is for.
    """
    description = run.descriptions.get(run.frame.path)
    if description is None or run.scope.ledger.incomplete:
        return
    if action.if_ is not None or action.unless is not None:
        return
    before = next((at for at, other in enumerate(description.actions) if other is action), 0)
    declared = [
        other
        for other in description.actions[:before]
        if isinstance(other, Arg) and other.name.constant == name.text
    ]
    if not declared or name.text in names_in(part.action for part in run.scope.ledger.hidden):
        return
    message = (
        f"what is given for the argument '{name.text}' never counts: nothing reads it before it is set here"
    )
    notes = (f"it is declared at {run.at(declared[-1].name.span)}",)
    run.problems.warning(Code.SHADOWED_ARGUMENT, message, name.location, notes=notes)
