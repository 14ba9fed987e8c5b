"""Splits `cmd`, `args` and `ros_args` into words by shell rules.

Upstream splits each literal piece on its own, so that quotes around a substitution are an error there. Here the pieces
are read as one text in which the result of a substitution is an indivisible character: it is never split, whether it
stands in quotes or not, and an empty one by itself is an empty word. An empty text has no words; what
that means is for the caller to say (upstream makes it one empty word).
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.description.text import MatchedTemplate, Opaque, Words
from orchestra.errors import Code
from orchestra.fields import field
from orchestra.load.offsets import Source, is_on_one_line
from orchestra.location import Span, inside, is_within, offsets_of, stretch, whole_of
from orchestra.patterns import pattern
from orchestra.resolve.bare_words import WORD, bare_words
from orchestra.resolve.context import POISON, Poison, Read, Value, new_value
from orchestra.resolve.evaluate import evaluate, perform

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.text import Call, Template
    from orchestra.resolve.context import Context

_BLANKS: Final = " \t\r\n"
# Text without quotes and backslashes.
_BARE: Final = pattern(r"""[^\\'"]*""")
_RUN: Final = pattern(r"""[^\\'" \t\r\n]+|.""", re.DOTALL)


def split(argv: Template | tuple[Template, ...], context: Context) -> tuple[Value, ...] | Poison:
    """Return the words, each pointing at where it is written; quotes and backslashes act as in `shlex.split`.

    Each item of a list is exactly one word, whatever it holds.
    """
    if not isinstance(argv, tuple):
        return _split(argv, context)
    values = [evaluate(item, context) for item in argv]
    sound = tuple(value for value in values if isinstance(value, Value))
    return sound if len(sound) == len(values) else POISON


def _split(template: Template, context: Context) -> tuple[Value, ...] | Poison:
    if type(template) is MatchedTemplate and _BARE.fullmatch(template.raw):
        bare = bare_words(template, context)
        if bare is not None:
            return bare
    if all(type(part) is not Words or _BARE.fullmatch(part.text) for part in template.parts):
        return _at_blanks(template, context)
    splitter = _Splitter()
    poisoned = template.faulty
    for part in template.parts:
        if isinstance(part, Words):
            _read(part, splitter)
            continue
        with context.variables.tracing() as reads:
            value = perform(part, context)
        if isinstance(value, Poison):
            poisoned = True
        else:
            splitter.substituted(value.text, part.span, reads, _as_written(part))
    if poisoned:
        return POISON
    splitter.end()
    for span, told in splitter.faults:
        _report(told, span, context)
    return POISON if splitter.faults else _values(splitter.words, context)


def _values(words: Sequence[_Word], context: Context) -> tuple[Value, ...]:
    return tuple(
        new_value(word.text, context.at(word.span), through=word.reads, raw=word.raw) for word in words
    )


def _at_blanks(template: Template, context: Context) -> tuple[Value, ...] | Poison:
    """Return the words of a text in which nothing escapes."""
    words: list[_Word] = []
    goes_on, poisoned = False, template.faulty
    for part in template.parts:
        begins = ends = True
        if isinstance(part, Words):
            if not (text := part.text):
                continue
            found = [_Word(word[0], _place(part, *word.span()), (), word[0]) for word in WORD.finditer(text)]
            begins, ends = text[0] not in _BLANKS, text[-1] not in _BLANKS
        else:
            with context.variables.tracing() as reads:
                value = perform(part, context)
            if isinstance(value, Poison):
                poisoned = True
                continue
            found = [_Word(value.text, part.span, tuple(reads), _as_written(part))]
        if goes_on and begins:
            found[0] = _both(words.pop(), found[0])
        words += found
        goes_on = ends
    return POISON if poisoned else _values(words, context)


def _both(word: _Word, more: _Word) -> _Word:
    """Return the word that two are without a blank between them."""
    raw = None if word.raw is None or more.raw is None else word.raw + more.raw
    return _Word(word.text + more.text, _joined(word.span, more.span), word.reads + more.reads, raw)


def _as_written(part: Call | Opaque) -> str | None:
    """Return a substitution as it is written, None where quotes or others in it leave that open."""
    if isinstance(part, Opaque) or any(item.quoted for item in part.arguments):
        return None
    return f"$({' '.join([part.name, *(item.raw for item in part.arguments)])})"


def _read(words: Words, splitter: _Splitter) -> None:
    """Read literal text: outside of quotes, what no character of has a meaning is taken at once."""
    for found in _RUN.finditer(words.text):
        begin, end = found.span()
        if end - begin > 1 and not splitter.backslash and not splitter.quote:
            splitter.append(found[0], _place(words, begin, end))
            continue
        for offset in range(begin, end):
            splitter.literal(words.text[offset], _place(words, offset, offset + 1))


def _report(told: str, span: Span, context: Context) -> None:
    """Report a fault; a warning of the quote in question, which nothing opens, gives way to it with its place."""
    problems = context.problems
    warned = [
        known
        for known in problems
        if known.code is Code.SURPRISING_SCALAR and known.span is not None and is_within(span, known.span)
    ]
    if warned:
        problems.amend(lambda known: None if known in warned else known)
    place, instead = (warned[0].span or span, warned[0].suggestion) if warned else (span, None)
    problems.error(Code.SUBSTITUTION_SYNTAX, told, context.at(place), suggestion=instead)


@dataclass(frozen=True, slots=True)
class _Word:
    """A word: its text, its place, what was read for it, and what stands there where no quotes do."""

    text: str
    span: Span
    reads: tuple[Read, ...]
    raw: str | None


@dataclass(slots=True)
class _Splitter:
    """The state between two characters: behind which backslash, inside which quote, within which word.

    `raw` are the pieces of the current word as they are written, None among them for what is not known.
    """

    words: list[_Word] = field(default_factory=list)
    faults: list[tuple[Span, str]] = field(default_factory=list)
    backslash: Span | None = None
    quote: str = ""
    quote_at: Span | None = None
    pieces: list[str] | None = None
    spans: list[Span] = field(default_factory=list)
    raw: list[str | None] = field(default_factory=list)
    reads: list[Read] = field(default_factory=list)

    def literal(self, character: str, span: Span) -> None:
        """Take a character of the literal text."""
        if self.backslash:
            kept = "\\" if self.quote and character not in (self.quote, "\\") else ""
            self.append(kept + character, span)
            self.backslash = None
        elif character == "\\" and self.quote != "'":
            self.append("", span)
            self.backslash = span
        elif self.quote:
            self.append("" if character == self.quote else character, span)
            self.quote = "" if character == self.quote else self.quote
        elif character in "'\"":
            self.append("", span)
            self.quote, self.quote_at = character, span
        elif character in _BLANKS:
            self.finish()
        else:
            self.append(character, span)

    def substituted(self, text: str, span: Span, reads: Sequence[Read], raw: str | None) -> None:
        """Take the result of a substitution, which stands there as `raw`."""
        self.end_of_backslash()
        self.append(text, span)
        self.raw[-1] = raw
        self.reads += reads

    def append(self, text: str, span: Span) -> None:
        """Add to the current word, which begins here where there is none."""
        if self.pieces is None:
            self.pieces = []
        self.pieces.append(text)
        self.raw.append(text or None)
        self.spans.append(span)

    def finish(self) -> None:
        """Finish the current word, if there is one."""
        if self.pieces is not None:
            raw = [piece for piece in self.raw if piece is not None]
            self.words.append(
                _Word(
                    "".join(self.pieces),
                    _joined(self.spans[0], self.spans[-1]),
                    tuple(self.reads),
                    "".join(raw) if len(raw) == len(self.raw) else None,
                )
            )
        self.pieces = None
        self.spans.clear()
        self.raw.clear()
        self.reads.clear()

    def end(self) -> None:
        """Finish the text."""
        self.end_of_backslash()
        if self.quote and self.quote_at:
            self.faults.append((self.quote_at, f"this {self.quote} is not closed"))
        self.finish()

    def end_of_backslash(self) -> None:
        """Report a backslash with no character behind it."""
        if self.backslash:
            self.faults.append((self.backslash, "this backslash escapes nothing"))
        self.backslash = None


def _place(words: Words, begin: int, end: int) -> Span:
    """Return the place of characters: exact where the text is written as it reads, else that of the whole piece."""
    span = words.span
    if not is_on_one_line(span):
        return span
    offsets = _offsets(span)
    if offsets is not None:  # the lines of the file need not be counted
        return inside(span, begin, end) if offsets[1] - offsets[0] == len(words.text) else span
    exact = span.end_column - span.column == len(words.text)
    return Span(span.file, span.line, span.column + begin, span.line, span.column + end) if exact else span


def _joined(first: Span, last: Span) -> Span:
    whole, begin, end = whole_of(first), _offsets(first), _offsets(last)
    if whole is not None and begin is not None and end is not None and whole_of(last) is whole:
        return stretch(whole, begin[0], end[1])
    return Span(first.file, first.line, first.column, last.end_line, last.end_column)


def _offsets(span: Span) -> tuple[int, int] | None:
    """Return the two offsets of a span that has some in the text of a file as it is."""
    return offsets_of(span) if type(whole_of(span)) is Source else None
