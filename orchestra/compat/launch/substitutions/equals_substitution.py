"""`EqualsSubstitution`: whether two values are equal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.described import described
from orchestra.compat.launch.utilities.type_utils import is_substitution
from orchestra.compat.parsed import ParsedSubstitution
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.substitution import Substitution


class EqualsSubstitution(ParsedSubstitution):
    """True where both are equal: as booleans where both are, else as numbers, else as text.

    A side is a substitution, or several with texts, or any Python value: None is an empty text, the rest its `str`.
    """

    _name = "equals"
    _parameters = ("left", "right")

    def __init__(self, left: Any, right: Any) -> None:
        super().__init__()
        self.__left = _side(left)
        self.__right = _side(right)

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


def _side(value: Any) -> list[Substitution]:
    if is_substitution(value):
        return normalized(value)
    if value is None:
        return normalized("")
    return normalized(str(value).lower() if isinstance(value, bool) else str(value))
