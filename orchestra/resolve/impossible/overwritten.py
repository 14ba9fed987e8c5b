"""Arguments that a file overwrites before anything reads them: whoever gives a value for one gives it in vain."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.description.actions.arg import Arg
from orchestra.errors import Code
from orchestra.resolve.mentions import names_in

if TYPE_CHECKING:
    from orchestra.description.actions.let import Let
    from orchestra.description.launch import Description
    from orchestra.resolve.context import Value
    from orchestra.resolve.ledger import Ledger
    from orchestra.resolve.resolution import Resolution


class _Seen:
    """What a look at the actions of a file has found, for all that it sets: a file may set thousands of variables."""

    def __init__(self, description: Description) -> None:
        self.description = description
        self.places: dict[int, int] = {}
        self.declared: dict[str | None, list[tuple[int, Arg]]] = {}
        for at, action in enumerate(description.actions):
            self.places.setdefault(id(action), at)
            if isinstance(action, Arg):
                self.declared.setdefault(action.name.constant, []).append((at, action))
        self._ledger: Ledger | None = None
        self._hidden, self._names = 0, set[str]()

    def hidden_by(self, ledger: Ledger) -> set[str]:
        """Return the names in what conditions have left out; more of that comes only at its end."""
        if ledger is not self._ledger:
            self._ledger, self._hidden, self._names = ledger, 0, set()
        self._names |= names_in(part.action for part in ledger.hidden[self._hidden :])
        self._hidden = len(ledger.hidden)
        return self._names


_last: list[_Seen] = []


def _seen(description: Description) -> _Seen:
    """Return what was found in a file, which is kept for that alone that was looked at last."""
    if not _last or _last[0].description is not description:
        _last[:] = [_Seen(description)]
    return _last[0]


def check_overwritten(action: Let, name: Value, run: Resolution) -> None:
    """Tell of a variable that is set in any case, of an argument that the same file declares and nothing has read.

    One that is set in a group, or where a condition says so, may be what the file is for.
    """
    description = run.descriptions.get(run.frame.path)
    if description is None or run.scope.ledger.incomplete:
        return
    if action.if_ is not None or action.unless is not None:
        return
    seen = _seen(description)
    before = seen.places.get(id(action), 0)
    declared = [other for at, other in seen.declared.get(name.text, ()) if at < before]
    if not declared or name.text in seen.hidden_by(run.scope.ledger):
        return
    message = (
        f"what is given for the argument '{name.text}' never counts: nothing reads it before it is set here"
    )
    notes = (f"it is declared at {run.at(declared[-1].name.span)}",)
    run.problems.warning(Code.SHADOWED_ARGUMENT, message, name.location, notes=notes)
