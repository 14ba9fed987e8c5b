"""`IfElseSubstitution`: one of two values."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.calculating import Calculating, plain
from orchestra.compat.calls import own
from orchestra.compat.described import described
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub


class IfElseSubstitution(Calculating):
    """The first value where the condition is true, else the second; only the chosen one is performed.

    Raises `RuntimeError` where both are empty.
    """

    _name = "if"
    _parameters = ("condition", "if_value", "else_value")
    _count = 3
    __condition: list[Substitution] = own()
    __if_value: list[Substitution] = own()
    __else_value: list[Substitution] = own()

    def __init__(self, condition: Sub, if_value: Sub = "", else_value: Sub = "") -> None:
        super().__init__()
        if if_value == "" and else_value == "":
            raise RuntimeError("an IfElseSubstitution needs an if_value or an else_value")
        self.__condition = normalized(condition)
        self.__if_value = normalized(if_value)
        self.__else_value = normalized(else_value)

    def _keep(self, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> bool:
        return "" not in [item for item in arguments if type(item) is str] and super()._keep(
            arguments, keywords
        )

    @property
    def condition(self) -> list[Substitution]:
        """The condition."""
        return self.__condition

    @property
    def if_value(self) -> list[Substitution]:
        """The value where it is true."""
        return self.__if_value

    @property
    def else_value(self) -> list[Substitution]:
        """The value where it is false."""
        return self.__else_value

    def describe(self) -> str:
        """Return the condition and both values."""
        return f"IfElseSubstitution({', '.join(map(described, self._arguments()))})"

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        return (self.condition, self.if_value, self.else_value)


plain.add(IfElseSubstitution)
