"""Substitutions that come to `true` or `false`: not, and, or, any, all."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self

from orchestra.compat.calculating import Calculating, plain
from orchestra.compat.calls import own
from orchestra.compat.described import described
from orchestra.compat.launch.substitutions.two_sided import TwoSided
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.place import Step
    from orchestra.compat.text import Sub


class NotSubstitution(Calculating):
    """True where the value is false."""

    _name = "not"
    _parameters = ("value",)
    __value: list[Substitution] = own()

    def __init__(self, value: Sub) -> None:
        super().__init__()
        self.__value = normalized(value)

    @property
    def value(self) -> list[Substitution]:
        """The value."""
        return self.__value

    def describe(self) -> str:
        """Return the value and what it is."""
        return f"NotSubstitution({described(self.value)})"

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        return (self.value,)


class AndSubstitution(TwoSided):
    """True where both values are."""

    _name = "and"


class OrSubstitution(TwoSided):
    """True where at least one of two values is."""

    _name = "or"


class _OfMany(Calculating):
    """Any number of values, which are all evaluated; the front ends hand them in as `args`."""

    _count = None
    __args: list[list[Substitution]] = own()

    def __init__(self, *values: Sub, args: Sequence[Sub] = ()) -> None:
        super().__init__()
        self.__args = [normalized(value) for value in (*values, *args)]

    @classmethod
    def parse(cls, data: Sequence[Sub]) -> tuple[type[Self], dict[str, Any]]:
        """Return the class and the keywords of its constructor."""
        return cls, {"args": data}

    @property
    def args(self) -> list[list[Substitution]]:
        """The values."""
        return self.__args

    def describe(self) -> str:
        """Return the values and what they are in."""
        return f"{type(self).__name__}({', '.join(map(described, self.args))})"

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        return self.args

    def _paths(self) -> Sequence[tuple[Step, ...]]:
        return [(f"*{index}",) for index in range(len(self.args))]


class AnySubstitution(_OfMany):
    """True where at least one value is; false without values."""

    _name = "any"


class AllSubstitution(_OfMany):
    """True where every value is; true without values."""

    _name = "all"


plain.update((NotSubstitution, AndSubstitution, OrSubstitution, AnySubstitution, AllSubstitution))
