"""What the controller can be told to do."""

from enum import StrEnum


class Mode(StrEnum):
    """One way of driving; the value is the name used in parameters, services and messages."""

    LINEAR = "linear"
    ROTATIONAL = "rotational"
    WANDER = "wander"
    HOLD = "hold"


def following(mode: Mode) -> Mode:
    """The mode that `switch_mode` goes to: the next in the order above, and round again."""
    order = list(Mode)
    return order[(order.index(mode) + 1) % len(order)]
