"""What the observer says, line by line: only what has the right shape gets through to those who wait for it."""

from __future__ import annotations

import json
from typing import Any

# By what is said, and for `done` by what was to be done: the facts that belong to it.
_FACTS: dict[str, dict[str, type | tuple[type, ...]]] = {
    "asking": {},
    "watching": {},
    "moved": {"transition": str, "start_state": str, "goal_state": str},
    "rate": {"rate": (int, float)},
    "impossible": {"reason": str},
}
_RESULTS: dict[str, dict[str, type | tuple[type, ...]]] = {
    "watch": {},
    "change_state": {"state": str},
    "load": {"node": str, "unique_id": int},
}
_FINAL = ("done", "impossible")


def heard(line: str) -> dict[str, Any] | None:
    """Return the message in a line, None where it is none."""
    try:
        message = json.loads(line)
    except (ValueError, RecursionError):
        return None
    if not isinstance(message, dict):
        return None
    spoken = all(isinstance(message.get(name), str) for name in ("id", "say"))
    return message if spoken or "pong" in message else None


def fits(message: dict[str, Any], done: str) -> bool:
    """Tell whether this can be said to an order to do something."""
    word = message.get("say")
    facts = _RESULTS.get(done) if word == "done" else _FACTS.get(str(word))
    return facts is not None and all(isinstance(message.get(name), kind) for name, kind in facts.items())


def is_final(message: dict[str, Any]) -> bool:
    """Tell whether nothing more will be said to the order."""
    return message["say"] in _FINAL
