"""Predicates on actions that are nodes."""

from __future__ import annotations

from orchestra.compat.launch.events.matchers import ActionMatcher


def matches_node_name(node_name: str) -> ActionMatcher:
    """Return the predicate that holds for the node with a full name; a slash in front may be left out."""
    return ActionMatcher("node_name", node_name if node_name.startswith("/") else f"/{node_name}")
