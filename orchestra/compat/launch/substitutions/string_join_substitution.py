"""`StringJoinSubstitution`: texts with a delimiter between them (newer ROS releases)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self

from orchestra.compat.described import described
from orchestra.compat.parsed import ParsedSubstitution
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.place import Step
    from orchestra.compat.text import Sub


class StringJoinSubstitution(ParsedSubstitution):
    """The components with a delimiter between them; one that is a list is concatenated first."""

    _name = "string-join"

    def __init__(self, substitutions: Iterable[Sub], delimiter: Sub = "") -> None:
        super().__init__()
        self.__substitutions = [normalized(item) for item in substitutions]
        self.__delimiter = normalized(delimiter)

    @classmethod
    def parse(cls, data: Sequence[Sub]) -> tuple[type[Self], dict[str, Any]]:
        """Return the class and the keywords of its constructor: the delimiter stands first."""
        if not data:
            raise TypeError("$(string-join) takes a delimiter and the texts")
        return cls, {"delimiter": data[0], "substitutions": data[1:]}

    @property
    def substitutions(self) -> list[list[Substitution]]:
        """The components."""
        return self.__substitutions

    @property
    def delimiter(self) -> list[Substitution]:
        """What stands between them."""
        return self.__delimiter

    def describe(self) -> str:
        """Return the components and the delimiter."""
        components = ", ".join(map(described, self.substitutions))
        return f"StringJoin([{components}], delimiter={described(self.delimiter)})"

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        return (self.delimiter, *self.substitutions)

    def _paths(self) -> Sequence[tuple[Step, ...]]:
        return [("delimiter",), *(("substitutions", index) for index in range(len(self.substitutions)))]
