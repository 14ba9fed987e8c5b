"""Predicates on actions, which tell whom an event is for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from orchestra.compat.place import here
from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from collections.abc import Callable

By: TypeAlias = Literal["action", "pid", "name", "executable", "node_name"]


@dataclass(frozen=True, slots=True, eq=False)
class ActionMatcher:
    """A predicate that says what it looks for, so that a plan can name the processes that it holds for.

    `by` is the property of the action that is compared with `target`: the object itself, the process id, the final
    name of the process, the end of its program, or the full name of the node.
    """

    by: By
    target: Any

    def __call__(self, action: Any) -> bool:
        """Return whether an action is meant; one that has not been executed has no process to compare."""
        if self.by == "action":
            return action is self.target
        if self.by == "node_name":
            return bool(action.node_name == self.target)
        details = action.process_details
        if details is None:
            return False
        if self.by == "executable":
            return bool(details["cmd"][0].endswith(self.target))
        return bool(details.get(self.by) == self.target)


def checked_matcher(name: str, given: Callable[[Any], bool]) -> Callable[[Any], bool]:
    """Return a predicate as it is, and that of an action which is given in place of one: ROS 2 fails to call it."""
    if callable(given) or given is None:
        return given
    from orchestra.compat.refused_upstream import tell_no_predicate  # noqa: PLC0415 - few are that wrong

    tell_no_predicate(name, given, here())
    return matches_action(given)


def matches_action(target_action: Any) -> ActionMatcher:
    """Return the predicate that holds for this very action."""
    return ActionMatcher("action", target_action)
