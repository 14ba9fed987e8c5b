"""Whose velocity the robot obeys at a moment."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bringup.arbiter.settings import Source

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bringup.arbiter.settings import Settings

NOBODY = "none"


@dataclass(frozen=True, slots=True)
class Choice:
    """The input in force, if any; else the name of the lock that holds, or `none`."""

    input: Source | None
    holder: str


def chosen(
    settings: Settings, heard: Mapping[str, float], locked: Mapping[str, tuple[float, bool]], now: float
) -> Choice:
    """Who is in force at time `now`.

    `heard` has the time of each input's last message by the input's name, `locked` that of each lock's, and what
    it said. A time after `now` means a clock that was set back: the message counts no more, but a lock still holds.
    """
    lock = max(
        (each for each in settings.locks if is_locked(each, locked.get(each.name), now)),
        key=lambda each: each.priority,
        default=None,
    )
    least = -1 if lock is None else lock.priority
    fresh = [each for each in settings.inputs if is_fresh(each, heard.get(each.name), now)]
    best = max(fresh, key=lambda each: each.priority, default=None)
    if best is not None and best.priority > least:
        return Choice(best, best.name)
    return Choice(None, NOBODY if lock is None else lock.name)


def is_fresh(source: Source, at: float | None, now: float) -> bool:
    """Whether an input's last message still counts."""
    return at is not None and 0.0 <= now - at <= source.timeout


def is_locked(source: Source, said: tuple[float, bool] | None, now: float) -> bool:
    """Whether a lock holds: it said so, or it has a time-out and has fallen silent or never spoken."""
    if said is None:
        return source.timeout > 0.0
    at, value = said
    return value or (source.timeout > 0.0 and not 0.0 <= now - at <= source.timeout)
