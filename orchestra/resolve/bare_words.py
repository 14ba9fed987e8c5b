"""Words of texts of which a file says plainly where they end: nothing escapes, and only variables are substituted."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, TypeAlias

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
    raw, included_from = template.raw, context.included_from
    layout, known = _LAYOUTS.get(raw), _NOTHING
    if template.constant is None:
        pieces = template.pieces
        if type(pieces) is not Pieces or pieces.variables is None:  # those of code stand at no offsets
            return None
        reads = context.variables.known(pieces.variables)
        if reads is None:
            return None
        known = reads
        if layout is None:
            layout = _laid_out(raw, pieces.pieces)
    elif layout is None:
        layout = _laid_out(raw, (raw,))
    words: list[Any] = []
    for text, at, parts in layout:
        word: Any = _new(WordValue)
        word.template = template
        word.at = at
        word.included_from = included_from
        if parts is None:
            word.text, word.through = text, _NOTHING
        elif text is None:  # a variable alone
            read = known[parts[0]]
            word.text, word.through = read.value, (read,)
        else:
            word.text = "".join([part if type(part) is str else known[part].value for part in parts])
            word.through = tuple([known[part] for part in parts if type(part) is not str])
        words.append(word)
    return tuple(words)


_NOTHING: Final[tuple[Read, ...]] = ()
# Where the words of a text are, by the text: many nodes are given the same. Of a word its text, where it stands, and of
# which texts and variables by their number it is made, None for a text alone; of a variable alone the text is None.
_Layout: TypeAlias = "tuple[tuple[str | None, tuple[int, int], tuple[Any, ...] | None], ...]"
_LAYOUTS: Final[dict[str, _Layout]] = {}
_MOST: Final = 1024


def _laid_out(raw: str, pieces: Sequence[Piece]) -> _Layout:
    """Return where the words are, and keep that."""
    words: list[tuple[tuple[Any, ...], tuple[int, int]]] = []
    at, number, last = 0, 0, -1
    for piece in pieces:
        found: list[tuple[tuple[Any, ...], tuple[int, int]]]
        if isinstance(piece, str):
            found = [((word[0],), (at + word.start(), at + word.end())) for word in WORD.finditer(piece)]
            at += len(piece)
        else:
            found = [((number,), (at, at + piece.length))]
            at, number = at + piece.length, number + 1
        if found and found[0][1][0] == last:  # behind the word before it without a blank
            (parts, (begin, _)), (more, (_, end)) = words.pop(), found[0]
            found[0] = (parts + more, (begin, end))
        words += found
        last = found[-1][1][1] if found else -1
    if len(_LAYOUTS) >= _MOST:
        _LAYOUTS.clear()
    layout = _LAYOUTS[raw] = tuple([_word(parts, place) for parts, place in words])
    return layout


def _word(
    parts: tuple[Any, ...], place: tuple[int, int]
) -> tuple[str | None, tuple[int, int], tuple[Any, ...] | None]:
    if len(parts) > 1:
        return "", place, parts
    return (parts[0], place, None) if isinstance(parts[0], str) else (None, place, parts)
