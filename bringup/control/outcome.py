"""How a journey to a goal can end."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum


class Outcome(IntEnum):
    """The numbers of the action `GoToGoal`."""

    REACHED = 1
    UNREACHABLE = 2
    CANCELED = 3
    PREEMPTED = 4
    OVERRULED = 5
    LOST = 6
    REFUSED = 7


@dataclass(frozen=True, slots=True)
class Result:
    """The outcome and its reason in words."""

    outcome: Outcome
    text: str
