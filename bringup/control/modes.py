"""What the controller can be told to do."""

from enum import StrEnum


class Mode(StrEnum):
    """One way of driving; the value is the name used in parameters, services and messages."""

    LINEAR = "linear"
    ROTATIONAL = "rotational"
    WANDER = "wander"
    HOLD = "hold"
    GO_TO_GOAL = "go_to_goal"


# All but the mode that says nothing without a goal, which an action gives.
SIMPLE = tuple(mode for mode in Mode if mode is not Mode.GO_TO_GOAL)


def following(mode: Mode) -> Mode:
    """The mode that `switch_mode` goes to: the next of the simple ones in the order above, and round again."""
    at = SIMPLE.index(mode) if mode in SIMPLE else -1
    return SIMPLE[(at + 1) % len(SIMPLE)]
