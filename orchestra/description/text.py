"""Text with substitutions, as the loaders read it: every part knows where it stands.

Of a text in a file that was matched by what was learned of others, parts and places are made when somebody asks for
them: most are read once, as what they come to.
"""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING, Any, Self, TypeAlias

from orchestra.dataclass import dataclass, maker
from orchestra.location import Location, Matched, Span, inside, location_of, new_location
from orchestra.values import ParameterValue

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


@dataclass(frozen=True, slots=True)
class Words:
    """A piece of literal text, escapes already taken away."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class Call:
    """One substitution, `$(name argument ...)`; the span covers it from the dollar to the closing parenthesis."""

    name: str
    arguments: tuple[Template, ...]
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Opaque:
    """A substitution that only its object in a Python launch file can perform.

    `inside` are the texts that it is known to be made of.
    """

    target: Any
    span: Span
    inside: tuple[Template, ...] = ()


Part: TypeAlias = Words | Call | Opaque


@dataclass(frozen=True, slots=True)
class Template:
    """A value as written: its parts are concatenated when it is evaluated.

    `raw` is the text as written (after the file format's own quoting). `quoted` says that the user's format marks it
    as a string (a YAML scalar in quotes), which keeps a text without substitutions from being read as a number.
    `faulty` marks a value whose fault has been reported already: it evaluates to poison.
    """

    parts: tuple[Part, ...]
    raw: str
    span: Span
    quoted: bool = False
    faulty: bool = False

    def location(self, included_from: tuple[Span, ...]) -> Location:
        """Return where it stands, in a file that these includes have led to."""
        return new_location(self.span, included_from)

    @property
    def action(self) -> Any:  # noqa: ANN401 - any object
        """The action of a Python launch file that stands where a name could, None where a text does."""
        match self.parts:
            case (Opaque(target=target),) if not hasattr(target, "perform"):
                return target
        return None

    @property
    def constant(self) -> str | None:
        """The text where nothing needs evaluating, else None."""
        if self.faulty:
            return None
        texts = []
        for part in self.parts:
            if type(part) is not Words:
                return None
            texts.append(part.text)
        return "".join(texts)


@dataclass(frozen=True, slots=True)
class Constant:
    """A value that has its type already, as Python's `1e-6`, `True` or `'text'`: it is used as it is.

    A list may still be one whose items have several types.
    """

    value: ParameterValue
    span: Span


# What the loaders, and code, make thousands of.
new_constant = maker(Constant)
new_words = maker(Words)
new_call = maker(Call)
new_template = maker(Template)


class Items(tuple[Template, ...]):  # noqa: SLOT001 - a tuple has no room for slots
    """A list as it is written in a file, which knows where it stands."""

    span: Span

    def __new__(cls, items: Iterable[Template], span: Span) -> Self:
        """Return the list that stands at a place."""
        made = super().__new__(cls, items)
        made.span = span
        return made


def span_of(value: Template | Constant | tuple[Template | Constant, ...]) -> Span | None:
    """Return where a value begins, None for an empty list of Python code."""
    if isinstance(value, tuple) and value:
        return value[0].span
    return value.span if isinstance(value, Items | Template | Constant) else None


@dataclass(frozen=True, slots=True)
class PlainCall:
    """A call whose arguments are words, as it is written: each with the two offsets at which it stands in it.

    `variable` is the variable whose value it is, where it says nothing else.
    """

    name: str
    arguments: tuple[tuple[str, int, int], ...]
    length: int
    variable: str | None


@dataclass(frozen=True, slots=True)
class PlainPath:
    """The components of a path that code joins, each in pieces."""

    components: tuple[tuple[Any, ...], ...]


Piece: TypeAlias = "str | PlainCall"


@dataclass(frozen=True, slots=True)
class Pieces:
    """What is concatenated; and the variables that are, in order: all calls, or all `beside` `$(dirname)`."""

    pieces: tuple[Piece, ...]
    variables: tuple[str, ...] | None
    beside: tuple[str, ...] | None = None

    def filled(self, values: Sequence[str]) -> str:
        """Return the text with these values of the variables."""
        if len(self.pieces) == 1:
            return values[0]
        following = iter(values)
        return "".join([piece if type(piece) is str else next(following) for piece in self.pieces])

    def placed(self, whole: Span) -> tuple[Part, ...]:
        """Return them as parts of a text that stands at a place."""
        return _placed(self.pieces, whole)

    def placed_in(self, template: MatchedTemplate) -> tuple[Part, ...]:
        """Return them as parts of a text."""
        return self.placed(template.span)


def pieces_of(pieces: Sequence[Piece]) -> Pieces:
    """Return them with the variables among them."""
    calls = [piece for piece in pieces if isinstance(piece, PlainCall)]
    variables = tuple(call.variable for call in calls if call.variable is not None)
    others = {(call.name, call.arguments) for call in calls if call.variable is None}
    beside = variables if others == {("dirname", ())} else None
    return Pieces(tuple(pieces), None if others else variables, beside)


class MatchedTemplate(Template):
    """A text that stands where the group of a match does; equal to any other template that says the same.

    `constant` is the text where nothing needs evaluating.
    """

    __slots__ = ("_parts", "constant", "group", "matched", "pieces")

    faulty = False
    _parts: tuple[Part, ...]
    constant: str | None
    pieces: Pieces | None
    matched: Matched
    group: int

    def __new__(cls, *values: Any, **named: Any) -> Template:  # type: ignore[misc] # noqa: ANN401 - any field
        """Return an ordinary one: what is made of it with a change has values of its own."""
        return Template(*values, **named)

    @property
    def span(self) -> Span:
        """The place."""
        return self.matched.span(self.group)

    def location(self, included_from: tuple[Span, ...]) -> Location:
        """Return where it stands, in a file that these includes have led to."""
        return location_of(self.matched, self.group, included_from)

    @property
    def parts(self) -> tuple[Part, ...]:
        """What is concatenated, each part with its place."""
        try:
            return self._parts
        except AttributeError:
            made = self._words() if self.pieces is None else self.pieces.placed_in(self)
            object.__setattr__(self, "_parts", made)
            return made

    def _words(self) -> tuple[Part, ...]:
        """Return the literal words that all of it is."""
        return (new_words(self.raw, self.span),) if self.raw else ()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Template):
            return NotImplemented
        if isinstance(other, MatchedTemplate) and _said(self) == _said(other):
            return True
        return self.ordinary == getattr(other, "ordinary", other)

    def __hash__(self) -> int:
        return hash(self.ordinary)

    def __repr__(self) -> str:
        return repr(self.ordinary)

    def __reduce__(self) -> Any:  # noqa: ANN401 - what makes it, and of what
        return Template, (self.parts, self.raw, self.span, self.quoted, self.faulty)

    def __deepcopy__(self, memo: object) -> Self:
        return self

    @property
    def ordinary(self) -> Template:
        """The same as a template that has its parts."""
        return new_template(self.parts, self.raw, self.span, self.quoted, self.faulty)


_said = attrgetter("raw", "quoted", "pieces", "span")
_new = object.__new__


def matched_words(text: str, quoted: bool, matched: Matched, group: int) -> Template:
    """Return a text of literal words."""
    made: Any = _new(MatchedTemplate)
    made.raw = made.constant = text
    made.quoted = quoted
    made.matched = matched
    made.group = group
    made.pieces = None
    template: Template = made
    return template


def matched_template(text: str, quoted: bool, matched: Matched, group: int, pieces: Pieces) -> Template:
    """Return a text of words and calls."""
    made: Any = _new(MatchedTemplate)
    made.raw = text
    made.quoted = quoted
    made.matched = matched
    made.group = group
    made.pieces = pieces
    made.constant = text if pieces.variables == () else None
    template: Template = made
    return template


def _placed(pieces: Sequence[Piece], whole: Span) -> tuple[Part, ...]:
    parts: list[Part] = []
    at = 0
    for piece in pieces:
        if isinstance(piece, PlainCall):
            parts.append(_call(piece, whole, at))
            at += piece.length
        elif piece:
            parts.append(new_words(piece, inside(whole, at, at + len(piece))))
            at += len(piece)
    return tuple(parts)


def _call(call: PlainCall, whole: Span, at: int) -> Call:
    arguments = []
    for text, first, last in call.arguments:
        span = inside(whole, at + first, at + last)
        arguments.append(new_template((new_words(text, span),), text, span))
    return new_call(call.name, tuple(arguments), inside(whole, at, at + call.length))
