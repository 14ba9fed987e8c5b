"""Takes lifecycle nodes through transitions."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from orchestra.compat.launch_ros.events.lifecycle.change_state import ChangeState
from orchestra.compat.launch_ros.events.matchers import matches_node_name
from orchestra.errors import Code
from orchestra.resolve.context import Value
from orchestra.resolve.occasions import OpenAction
from orchestra.resolve.reactions import ResolvedChangeState
from orchestra.resolve.triggers import trigger

if TYPE_CHECKING:
    from orchestra.description.actions.lifecycle_transition import LifecycleTransition
    from orchestra.location import Location
    from orchestra.resolve.resolution import Resolution


def visit(action: LifecycleTransition, run: Resolution) -> None:
    """Order the transitions of each node."""
    names = [run.evaluate(name) for name in action.node]
    transitions = [_transition(action, index, run) for index in range(len(action.transition))]
    sound = tuple(transition for transition in transitions if transition is not None)
    if len(sound) < len(transitions):
        return
    for name in names:
        if isinstance(name, Value):
            make = partial(_change, sound, name.location)
            trigger(OpenAction(matches_node_name(name.text), name.location, make), run)


def _transition(action: LifecycleTransition, index: int, run: Resolution) -> int | None:
    """Return the id of a transition, None for a faulty one, which is reported."""
    written = action.transition[index]
    found = run.integer(written)
    if not isinstance(found, int):
        return None
    if found in ChangeState.valid_transitions:
        return found
    known = ", ".join(f"{number} ({word})" for number, word in ChangeState.valid_transitions.items())
    message = f"{found} is no transition of a lifecycle node, only: {known}"
    run.problems.error(Code.BAD_VALUE, message, run.at(written.span))
    return None


def _change(
    transitions: tuple[int, ...], location: Location, indexes: tuple[int, ...]
) -> ResolvedChangeState:
    return ResolvedChangeState(indexes, transitions, location)
