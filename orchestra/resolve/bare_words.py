"""Words of texts of which a file says plainly where they end: nothing escapes, and only variables are substituted."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.description.text import Pieces
from orchestra.location import inside, new_location
from orchestra.patterns import pattern
from orchestra.resolve.late_values import LateValue

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.text import MatchedTemplate, Piece
    from orchestra.location import Location, Span
    from orchestra.resolve.context import Context, Read, Value

WORD: Final = pattern(r"[^ \t\r\n]+")


class WordValue(LateValue):
    """A word of a text that stands where the group of a match does: at two offsets in it."""

    __slots__ = ("at", "included_from", "template")

    verbatim = False
    template: MatchedTemplate
    at: tuple[int, int]
    included_from: tuple[Span, ...]

    @property
    def location(self) -> Location:
        """The place."""
        return new_location(inside(self.template.span, *self.at), self.included_from)

    @property
    def raw(self) -> str | None:
        """What stands there, where a variable does."""
        return None if self.template.constant is not None else self.template.raw[self.at[0] : self.at[1]]


_new = object.__new__


def bare_words(template: MatchedTemplate, context: Context) -> tuple[Value, ...] | None:
    """Return the words of a text in which nothing escapes and only variables are substituted; else None."""
    nothing: tuple[Read, ...] = ()
    if template.constant is not None:
        found = [(word[0], word.span(), nothing) for word in WORD.finditer(template.raw)]
    else:
        pieces = template.pieces
        if type(pieces) is not Pieces or pieces.variables is None:  # those of code stand at no offsets
            return None
        known = context.variables.known(pieces.variables)
        if known is None:
            return None
        found = _words_of(pieces.pieces, known)
    words: list[Any] = []
    for text, at, reads in found:
        word: Any = _new(WordValue)
        word.text = text
        word.template = template
        word.at = at
        word.included_from = context.included_from
        word.through = reads
        words.append(word)
    return tuple(words)


def _words_of(
    pieces: Sequence[Piece], reads: Sequence[Read]
) -> list[tuple[str, tuple[int, int], tuple[Read, ...]]]:
    """Return each word with the offsets at which it stands, and what was read for it."""
    words: list[tuple[str, tuple[int, int], tuple[Read, ...]]] = []
    at, number, last = 0, 0, -1
    nothing: tuple[Read, ...] = ()
    for piece in pieces:
        if isinstance(piece, str):
            found = [
                (word[0], (at + word.start(), at + word.end()), nothing) for word in WORD.finditer(piece)
            ]
            at += len(piece)
        else:
            end = at + piece.length
            found = [(reads[number].value, (at, end), (reads[number],))]
            at, number = end, number + 1
        if found and found[0][1][0] == last:  # behind the word before it without a blank
            (text, (begin, _), noted), (more, (_, end), others) = words.pop(), found[0]
            found[0] = (text + more, (begin, end), noted + others)
        words += found
        last = found[-1][1][1] if found else -1
    return words
