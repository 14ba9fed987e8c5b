"""Predicates on the actions of processes."""

from __future__ import annotations

from orchestra.compat.launch.events.matchers import ActionMatcher


def matches_pid(pid: int) -> ActionMatcher:
    """Return the predicate that holds for the process with an id."""
    return ActionMatcher("pid", pid)


def matches_name(name: str) -> ActionMatcher:
    """Return the predicate that holds for the process with a final name, as `talker-1`."""
    return ActionMatcher("name", name)


def matches_executable(executable: str) -> ActionMatcher:
    """Return the predicate that holds where the first word of the command ends with a text."""
    return ActionMatcher("executable", executable)
