"""What a text comes to that is made of variables and of substitutions that do nothing but calculate.

How is found out once for all texts of a skeleton, and what once for all texts with the same values. Where there is
anything to tell, or anything else to read, a formula has nothing to say: the text is evaluated part by part then.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Final

from orchestra.description.calculated import DIGIT
from orchestra.resolve.formulas.expressions import Expression
from orchestra.resolve.formulas.slots import calculating, slot_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from orchestra.description.calculated import Calculated
    from orchestra.description.substitutions import Part, Shape
    from orchestra.resolve.context import Read, Variables
    from orchestra.resolve.formulas.slots import Piece, Slot

_MOST: Final = 256  # texts that are kept for a formula


class Formula:
    """What the texts of a skeleton come to. `telling` and `bare` are for who looks for mistakes in them."""

    __slots__ = ("_fixed", "_names", "_slot", "_texts", "bare", "shape", "telling")

    def __init__(self, shape: Shape) -> None:
        self.shape = shape
        self.telling: int | None = None
        self.bare: bool | None = None
        self._texts: dict[tuple[str, ...], str | None] = {}
        reading = _Reading()
        try:
            self._slot: Slot | None = slot_of(reading.pieces(shape))
        except _OtherError:
            self._slot = None
        self._names = reading.names
        self._fixed: tuple[str, ...] | None = None
        if all(type(piece) is str for name in self._names for piece in name):
            self._fixed = self.names(())  # no number of a text is in one

    def names(self, numbers: Sequence[str]) -> tuple[str, ...] | None:
        """Return the variables that a text with these numbers reads, in order; None where that is not known."""
        if self._slot is None:
            return None
        if self._fixed is not None:
            return self._fixed
        return tuple(
            [
                "".join([numbers[piece] if isinstance(piece, int) else piece for piece in name])
                for name in self._names
            ]
        )

    def text(self, calculation: Calculated, variables: Variables) -> tuple[str, tuple[Read, ...]] | None:
        """Return what a text comes to, and what was read for that, which is noted; None where that is not known."""
        names, slot = calculation.names, self._slot
        if names is None or slot is None:
            return None
        reads = variables.known(names)
        if reads is None:
            return None
        values = tuple([read.value for read in reads])
        if calculation.numbers:
            text = slot(values, calculation.numbers)
        elif values in self._texts:
            text = self._texts[values]
        else:
            if len(self._texts) == _MOST:
                self._texts.clear()
            text = self._texts[values] = slot(values, ())
        if text is not None:
            return text, reads
        noted = getattr(variables, "_reads", None)  # of a scope: it is all read, and noted, again
        if noted:
            del noted[len(noted) - len(reads) :]
        return None


@lru_cache(maxsize=256)
def _formula(skeleton: str, shape_of: Callable[[str], Shape | None]) -> Formula:
    shape = shape_of(skeleton)
    assert shape is not None  # noqa: S101 - else it were none
    return Formula(shape)


def formula_of(calculation: Calculated) -> Formula:
    """Return what a text comes to."""
    formula: Formula | None = calculation.formula
    if formula is None:
        formula = calculation.formula = _formula(calculation.skeleton, calculation.shape_of)
        calculation.names = formula.names(calculation.numbers)
    return formula


class _OtherError(Exception):
    """A text does more than to calculate."""


class _Reading:
    """What has been read of a text: its variables, each as its pieces, and how many numbers it has."""

    def __init__(self) -> None:
        self.names: list[tuple[str | int, ...]] = []
        self._numbers = 0

    def pieces(self, shape: Shape) -> list[Piece]:
        """Return what a text is made of."""
        found: list[Piece] = []
        for part in shape.parts:
            if part.arguments is None:
                found += self._words(part.text)
            else:
                found.append(self._call(part, part.arguments))
        return found

    def _words(self, text: str) -> list[str | int]:
        first, *others = text.split(DIGIT)
        found: list[str | int] = [first] if first else []
        for other in others:
            found.append(self._numbers)
            self._numbers += 1
            if other:
                found.append(other)
        return found

    def _call(self, call: Part, arguments: tuple[Shape, ...]) -> Slot:
        if call.text == "if" and any(part.arguments for shape in arguments[1:] for part in shape.parts):
            raise _OtherError  # what is read depends on the condition
        pieces = [self.pieces(argument) for argument in arguments]
        if call.text == "var":
            return self._variable(pieces)
        slot = calculating(call.text, [slot_of(argument) for argument in pieces])
        if call.text == "eval" and len(pieces) == 1:
            slot = Expression(pieces[0])
        if slot is None:
            raise _OtherError
        return slot

    def _variable(self, pieces: list[list[Piece]]) -> Slot:
        name = tuple([piece for piece in pieces[0] if isinstance(piece, str | int)])
        if len(pieces) > 1 or len(name) < len(pieces[0]):
            raise _OtherError
        number = len(self.names)
        self.names.append(name)
        return lambda values, _: values[number]
