"""Texts that differ by numbers alone: what they come to is found out once, from the skeleton that they share."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.description.text import Pieces

if TYPE_CHECKING:
    from orchestra.description.substitutions import Shape

DIGIT: Final = "0"  # it stands for a number in a skeleton


class Calculated(Pieces):
    """What such a text is made of.

    `formula` is what resolving makes of the skeleton, and `names` the variables that it reads, once somebody asks.
    """

    __slots__ = ("formula", "names", "numbers", "skeleton", "text")

    pieces = ()
    variables = None
    beside = None
    text: str
    skeleton: str
    numbers: tuple[str, ...]
    formula: Any
    names: tuple[str, ...] | None

    def __init__(self, text: str, skeleton: str, numbers: tuple[str, ...]) -> None:
        self.text = text
        self.skeleton = skeleton
        self.numbers = numbers
        self.formula = None
        self.names = None

    __setattr__ = object.__setattr__

    @staticmethod
    def shape_of(skeleton: str) -> Shape | None:
        """Return what a skeleton looks like; None where there may be something to tell of it."""
        raise NotImplementedError(skeleton)
