"""What the parts of a text come to, by the values of its variables and by its numbers."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from orchestra.resolve.booleans import boolean
from orchestra.resolve.substitutions.arguments import truth
from orchestra.resolve.substitutions.equality import equal

if TYPE_CHECKING:
    from collections.abc import Iterable

# None where it is not known here what it comes to, or where there is something to tell of it.
Slot: TypeAlias = Callable[[Sequence[str], Sequence[str]], "str | None"]
# Words, a number (which of them), or what is worked out.
Piece: TypeAlias = "str | int | Slot"


def slot_of(pieces: Sequence[Piece]) -> Slot:
    """Return what concatenates pieces."""
    if all(isinstance(piece, str) for piece in pieces):
        words = "".join(piece for piece in pieces if isinstance(piece, str))
        return lambda _values, _numbers: words
    if len(pieces) == 1 and callable(pieces[0]):
        return pieces[0]
    return lambda values, numbers: filled(pieces, values, numbers)


def filled(pieces: Iterable[Piece], values: Sequence[str], numbers: Sequence[str]) -> str | None:
    """Return what pieces come to together."""
    texts: list[Any] = [
        piece
        if isinstance(piece, str)
        else numbers[piece]
        if isinstance(piece, int)
        else piece(values, numbers)
        for piece in pieces
    ]
    return None if None in texts else "".join(texts)


def calculating(name: str, arguments: Sequence[Slot]) -> Slot | None:
    """Return what a substitution comes to that does nothing but calculate; None for any other."""
    of_texts = _OF_TEXTS.get(name)
    if of_texts is not None:
        return lambda values, numbers: _of_texts(of_texts, arguments, values, numbers)
    of_flags = _OF_FLAGS.get(name)
    if of_flags is not None:
        return lambda values, numbers: _of_flags(of_flags, arguments, values, numbers)
    if name == "if":
        return lambda values, numbers: _chosen(arguments, values, numbers)
    return None


def _of_texts(
    function: Callable[..., str], arguments: Sequence[Slot], values: Sequence[str], numbers: Sequence[str]
) -> str | None:
    texts = [argument(values, numbers) for argument in arguments]
    return None if None in texts else function(*texts)


def _of_flags(
    function: Callable[[list[bool]], bool],
    arguments: Sequence[Slot],
    values: Sequence[str],
    numbers: Sequence[str],
) -> str | None:
    flags = []
    for argument in arguments:
        text = argument(values, numbers)
        flag = None if text is None else boolean(text)
        if flag is None:
            return None
        flags.append(flag)
    return truth(function(flags))


def _chosen(arguments: Sequence[Slot], values: Sequence[str], numbers: Sequence[str]) -> str | None:
    condition, *others = arguments
    text = condition(values, numbers)
    flag = None if text is None else boolean(text)
    if flag is None:
        return None
    chosen = others[:1] if flag else others[1:]
    return chosen[0](values, numbers) if chosen else ""


# As the modules of `substitutions` perform them.
_OF_TEXTS: Final[dict[str, Callable[..., str]]] = {
    "equals": lambda left, right: truth(equal(left, right)),
    "not-equals": lambda left, right: truth(not equal(left, right)),
    "path-join": os.path.join,
    "string-join": lambda delimiter, *texts: delimiter.join(texts),
}
_OF_FLAGS: Final[dict[str, Callable[[list[bool]], bool]]] = {
    "all": all,
    "and": all,
    "any": any,
    "not": lambda flags: not flags[0],
    "or": any,
}
