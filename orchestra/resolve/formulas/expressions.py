"""Expressions with variables in texts, numbers and what calculates, as `'$(var mode)' == 'sim'`: compiled once.

Texts and numbers are the arguments of a function then. Any other expression, and one that has not been met more than a
few times, is put together as it stands, and worked out where it is one of constants.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, TypeAlias

from orchestra.patterns import pattern
from orchestra.resolve.formulas.slots import filled
from orchestra.resolve.substitutions.constant_expressions import CODE, FUNCTIONS, MISUSED, TEXT, of_constants

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from orchestra.resolve.formulas.slots import Piece, Slot

    # Gives an argument of the function, None where that is none.
    Argument: TypeAlias = Callable[[Sequence[str], Sequence[str]], Any]

_FEW: Final = 12  # for fewer values and numbers it takes more time to be compiled
_MOST: Final = 256  # pieces of an expression
_LONGEST: Final = 15  # digits of a number
# What stands for a piece while an expression is taken apart: one that is worked out, or a number.
_WORKED_OUT: Final = 0xE100
_NUMBER: Final = 0xE200
_MARK: Final = pattern("([\ue100-\ue2ff])")
_TOKEN: Final = pattern(
    rf" *+(?:({TEXT})|([\ue200-\ue2ff](?:\.[\ue200-\ue2ff])?+)(?![\w.\ue100-\ue2ff])|({CODE}))"
)
_SAFE: Final = pattern(r"[\w ./:+-]*")  # it stands in a text of an expression as it is


class Expression:
    """The expression of an `$(eval)`."""

    __slots__ = ("_arguments", "_function", "_met", "_pieces")

    def __init__(self, pieces: Sequence[Piece]) -> None:
        self._pieces = pieces
        self._met = 0
        self._function: Any = None
        self._arguments: list[Argument] = []

    def __call__(self, values: Sequence[str], numbers: Sequence[str]) -> str | None:
        """Return the `str` of what it gives; None where that is not known."""
        if self._met < _FEW:
            self._met += 1
            if self._met == _FEW:
                self._compile()
        if self._function is not None:
            arguments = [argument(values, numbers) for argument in self._arguments]
            if None not in arguments:
                try:
                    return str(self._function(*arguments))
                except Exception:  # noqa: BLE001 - whoever evaluates it in full tells why
                    return None
        text = filled(self._pieces, values, numbers)
        return None if text is None else of_constants(text.strip())

    def _compile(self) -> None:
        """Make the function, if it is one of texts, numbers and what calculates."""
        written = "".join(map(self._written, range(len(self._pieces)))).strip()
        if len(self._pieces) > _MOST or MISUSED.search(written):
            return
        code, at = "", 0
        while at < len(written):
            token = _TOKEN.match(written, at)
            if token is None or (token[0][-1].isalpha() and _MARK.match(written, token.end())):
                return
            at = token.end()
            if token[3] is None and _MARK.search(token[0]):
                code += f" _{len(self._arguments)} "
                self._arguments.append(
                    self._number(token[2]) if token[1] is None else self._text(token[1][1:-1])
                )
            else:
                code += token[0]
        names = ",".join(f"_{number}" for number in range(len(self._arguments)))
        try:
            self._function = eval(f"lambda {names}:{code}", {"__builtins__": FUNCTIONS})  # noqa: S307 - as above
        except Exception:  # noqa: BLE001 - as above
            return

    def _written(self, number: int) -> str:
        piece = self._pieces[number]
        if isinstance(piece, str):
            return piece
        return chr((_NUMBER if isinstance(piece, int) else _WORKED_OUT) + number)

    def _pieces_of(self, text: str) -> list[Piece]:
        found: list[Piece] = []
        for index, item in enumerate(_MARK.split(text)):
            if index % 2:
                piece = self._pieces[(ord(item) - _WORKED_OUT) % _MOST]
                found.append(_safe(piece) if callable(piece) else piece)
            elif item:
                found.append(item)
        return found

    def _text(self, text: str) -> Argument:
        pieces = self._pieces_of(text)
        if len(pieces) == 1 and callable(pieces[0]):
            return pieces[0]
        return lambda values, numbers: filled(pieces, values, numbers)

    def _number(self, text: str) -> Argument:
        pieces = self._pieces_of(text)
        if len(pieces) == 1 and isinstance(pieces[0], int):
            place = pieces[0]
            return lambda _, numbers: _number(numbers[place])
        return lambda values, numbers: _number(filled(pieces, values, numbers))


def _safe(slot: Slot) -> Slot:
    """Return what gives the same, but for what may not stand in a text of an expression as it is."""

    def safe(values: Sequence[str], numbers: Sequence[str]) -> str | None:
        text = slot(values, numbers)
        return None if text is None or _SAFE.fullmatch(text) is None else text

    return safe


def _number(text: str | None) -> float | None:
    """Return a number of Python, None for any other text."""
    if text is None or len(text) > _LONGEST:
        return None
    if "." in text:
        return float(text)
    return int(text) if text == "0" or text[0] != "0" else None
