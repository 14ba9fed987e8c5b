"""The words of interface declarations: types and policies."""

from __future__ import annotations

import re
from typing import Final

from orchestra.nearest import nearest

_TYPE: Final = re.compile(r"(?P<package>[A-Za-z]\w*)(?:/(?P<group>msg|srv|action))?/(?P<name>[A-Za-z]\w*)")
# What the middleware, or the other side, decides.
_OPEN: Final = frozenset({"system_default", "best_available", "unknown", ""})
_POLICIES: Final = {
    "reliability": ("best_effort", "reliable"),
    "durability": ("volatile", "transient_local"),
    "liveliness": ("automatic", "manual_by_topic"),
}


def full_type(word: str, kind: str) -> str | None:
    """Return a type with its group (`std_msgs/msg/String` for `std_msgs/String`), None for what is none."""
    found = _TYPE.fullmatch(word.strip())
    if found is None:
        return None
    group = (
        "msg"
        if kind in ("publishers", "subscriptions")
        else "srv"
        if kind.startswith("service")
        else "action"
    )
    return f"{found['package']}/{found['group'] or group}/{found['name']}"


def policy(key: str, word: str) -> str | None:
    """Return a policy in small letters, None where it leaves the choice to others.

    Raises `ValueError` with what is wrong and what was meant.
    """
    small = word.strip().lower()
    if small in _OPEN:
        return None
    known = _POLICIES[key]
    if small in known:
        return small
    raise ValueError(f"'{word}' is no {key}: that is {' or '.join(known)}", nearest(small, known))
