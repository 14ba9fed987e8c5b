"""The turns of `for` and `for_each`: the same actions again, with other values of what counts or names them.

As upstream, a turn is no scope: what the actions set stays set. Only the values of the turn end with it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.context import POISON
from orchestra.resolve.substitutions.turn import local_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from orchestra.description.actions.for_loop import ForEachLoop, ForLoop
    from orchestra.resolve.context import Evaluated
    from orchestra.resolve.resolution import Resolution


def carry_out(
    action: ForLoop | ForEachLoop, turns: Iterable[Mapping[str, Evaluated]] | None, run: Resolution
) -> None:
    """Visit the children once per turn; once with values that nobody knows where the turns are not known."""
    for turn in ({"": POISON},) if turns is None else turns:
        if not run.goes_on(action):
            return
        held = {name: run.scope.variables.get(name) for name in map(local_of, turn)}
        for name, value in turn.items():
            run.scope.set(local_of(name), value, run.at(action.span), "for_each")
        run.repetitions += 1
        run.visit(action.children, run)
        run.repetitions -= 1
        for name, variable in held.items():
            if variable is None:
                run.scope.forget(name)
            else:
                run.scope.set(name, variable.value, variable.location, variable.setter)
