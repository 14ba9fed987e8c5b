"""What the substitutions share that look at two values."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.calculating import Calculating
from orchestra.compat.calls import own
from orchestra.compat.described import described
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub


class TwoSided(Calculating):
    """The values on both sides; both are evaluated."""

    _parameters = ("left", "right")
    _count = 2
    __left: list[Substitution] = own()
    __right: list[Substitution] = own()

    def __init__(self, left: Sub, right: Sub) -> None:
        super().__init__()
        self.__left = normalized(left)
        self.__right = normalized(right)

    @property
    def left(self) -> list[Substitution]:
        """The first value."""
        return self.__left

    @property
    def right(self) -> list[Substitution]:
        """The second value."""
        return self.__right

    def describe(self) -> str:
        """Return both values and what they are in."""
        return f"{type(self).__name__}({described(self.left)}, {described(self.right)})"

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        return (self.left, self.right)
