"""Files in which `$(...)` is evaluated, and the way back from the text that this gives to the file."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable
from functools import lru_cache
from typing import TYPE_CHECKING, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.description.text import Words
from orchestra.errors import Problems
from orchestra.fields import field, replace
from orchestra.load.grammar import by_itself, parse_template
from orchestra.load.offsets import Source, source
from orchestra.resolve.context import Value
from orchestra.resolve.evaluate import perform

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.text import Template
    from orchestra.location import Location, Span
    from orchestra.resolve.context import Context, Read
    from orchestra.resolve.rcl.sections import Entry, Section

Back: TypeAlias = Callable[["Span"], "Span"]
Reads: TypeAlias = "tuple[tuple[Span, tuple[Read, ...]], ...]"


def substituted(text: str, file: str, context: Context) -> tuple[str, Back, Reads] | None:
    """Return a text evaluated, with a function from its spans to those of the file; None where it is faulty.

    With it comes what was read for each substitution that read something.

    As upstream, backslashes escape in the whole text. What is faulty has been reported to the context's collector.
    """
    known = _known(text, file)
    template = known or _parsed(text, file, context)
    sound = not template.faulty
    values: list[str] = []
    read: list[tuple[Span, tuple[Read, ...]]] = []
    for part in template.parts:
        if isinstance(part, Words):
            continue
        with context.variables.tracing() as reads:
            value = perform(part, context)
        if isinstance(value, Value):
            values.append(value.text)
            read += [(part.span, tuple(reads))] if reads else []
        else:
            sound = False
    if not sound:
        return None
    made = _evaluated(template, text, file, values) if known is None else _again(text, file, tuple(values))
    return *made, tuple(read)


@lru_cache(maxsize=64)  # by content: many nodes are given the same file
def _known(text: str, file: str) -> Template | None:
    """Return the parts of a text; None where there is something to tell of it, or others may have added to it."""
    found = Problems()
    template = by_itself(text, source(file, text).span, found)
    return None if len(found) else template


def _parsed(text: str, file: str, context: Context) -> Template:
    found = Problems()
    template = parse_template(text, source(file, text).span, found)
    for problem in found:
        context.problems.report(replace(problem, included_from=context.included_from))
    return template


@lru_cache(maxsize=64)  # as above
def _again(text: str, file: str, values: tuple[str, ...]) -> tuple[str, Back]:
    """Return what a text that is known comes to with these values of its substitutions."""
    template = _known(text, file)
    assert template is not None  # noqa: S101 - see above
    return _evaluated(template, text, file, values)


def _evaluated(template: Template, text: str, file: str, values: Sequence[str]) -> tuple[str, Back]:
    """Return a text with the values of its substitutions, with a function from its spans to those of the file."""
    made = _Made(source(file, text))
    following = iter(values)
    for part in template.parts:
        if isinstance(part, Words):
            made.words(part)
        else:
            made.value(next(following), part.span)
    whole = source(file, "".join(made.texts))
    return whole.text, lambda span: made.back(span, whole)


def placed_back(section: Section, back: Back) -> Section:
    """Return a section with its places in the file itself."""
    entries = tuple(_entry_placed_back(entry, back) for entry in section.entries)
    return replace(section, entries=entries, location=_location(section.location, back))


def _entry_placed_back(entry: Entry, back: Back) -> Entry:
    return replace(
        entry,
        location=_location(entry.location, back),
        key=_location(entry.key, back),
        items=tuple(_location(item, back) for item in entry.items),
    )


def _location(location: Location, back: Back) -> Location:
    return replace(location, span=back(location.span))


@dataclass(slots=True)
class _Made:
    """The pieces of the evaluated text: where each begins in it, and the offsets in the file that it is from."""

    whole: Source
    texts: list[str] = field(default_factory=list)
    begins: list[int] = field(default_factory=list)
    origins: list[range | list[int]] = field(default_factory=list)
    length: int = 0

    def words(self, words: Words) -> None:
        """Take literal text, which is written as it reads but for the backslashes."""
        offsets: list[int] = []
        at = self.whole.offset(words.span.line, words.span.column)
        for _ in words.text:
            offsets.append(at)
            at += 2 if self.whole.text[at] == "\\" and at + 1 < len(self.whole.text) else 1
        self._take(words.text, offsets)

    def value(self, text: str, span: Span) -> None:
        """Take what a substitution came to; all of it is from the whole substitution."""
        begin, end = (
            self.whole.offset(span.line, span.column),
            self.whole.offset(span.end_line, span.end_column),
        )
        self._take(text, range(begin, end))

    def back(self, span: Span, evaluated: Source) -> Span:
        """Return where a span of the evaluated text is from."""
        first = self._origin(evaluated.offset(span.line, span.column))
        last = evaluated.offset(span.end_line, span.end_column) - 1
        begin = first[0]
        end = max(begin, self._origin(last)[1]) if (span.line, span.column) != _end(span) else begin
        return self.whole.span(begin, end)

    def _take(self, text: str, origin: range | list[int]) -> None:
        self.texts.append(text)
        self.begins.append(self.length)
        self.origins.append(origin)
        self.length += len(text)

    def _origin(self, offset: int) -> tuple[int, int]:
        """Return the range in the file that a character of the evaluated text is from."""
        index = bisect_right(self.begins, offset) - 1
        if index < 0 or offset >= self.length:
            return len(self.whole.text), len(self.whole.text)
        origin = self.origins[index]
        if isinstance(origin, range):
            return origin.start, origin.stop
        at = origin[offset - self.begins[index]]
        return at, at + 1


def _end(span: Span) -> tuple[int, int]:
    return span.end_line, span.end_column
