"""Where a value was written: spans in files, and the includes on the way to them."""

from __future__ import annotations

import os
from operator import attrgetter
from typing import TYPE_CHECKING, Any, Final, Protocol

from orchestra.dataclass import dataclass, maker

if TYPE_CHECKING:
    import re
    from collections.abc import Callable


class Whole(Protocol):
    """The text of a file, in which every offset has a place."""

    @property
    def file(self) -> str:
        """The file, as it is shown to people."""

    def place(self, offset: int) -> tuple[int, int]:
        """Return the 1-based line and column of an offset in code points."""


@dataclass(frozen=True, order=True)
class Span:  # noqa: PLW1641 - its hash is that of its fields
    """A range of text. Lines and columns are 1-based, columns count code points, the end is exclusive.

    Of the many that a file has few are ever shown: one that is given by offsets gets its fields when the first is read.
    """

    __slots__ = ("_offsets", "column", "end_column", "end_line", "file", "line")

    file: str
    line: int
    column: int
    end_line: int
    end_column: int

    def __str__(self) -> str:
        whole = whole_of(self)
        if whole is None:
            return f"{self.file}:{self.line}:{self.column}"
        line, column = whole.place(self._offsets[1])  # type: ignore[attr-defined]  # its end need not be known
        return f"{whole.file}:{line}:{column}"

    def __reduce__(self) -> tuple[type[Span], tuple[str, int, int, int, int]]:
        return Span, (self.file, self.line, self.column, self.end_line, self.end_column)

    if not TYPE_CHECKING:  # for type checkers there are the fields above and no others

        def __eq__(self, other: object) -> bool:
            if type(other) is not Span:
                return NotImplemented
            offsets = getattr(self, "_offsets", None)
            if offsets is not None and offsets == getattr(other, "_offsets", None):
                return True
            return _fields(self) == _fields(other)

        def __getattr__(self, name: str) -> str | int:
            if name == "file":  # it is asked for by itself, and known without a look at the text
                return self._offsets[0].file
            if name not in FIELDS:
                raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
            for known, value in zip(FIELDS, all_of(self), strict=True):
                object.__setattr__(self, known, value)
            return object.__getattribute__(self, name)


FIELDS: Final = ("file", "line", "column", "end_line", "end_column")
_fields: Final = attrgetter(*FIELDS)
_new = object.__new__
_set_offsets: Callable[[Span, tuple[Whole, int, int]], None] = vars(Span)["_offsets"].__set__


def stretch(whole: Whole, begin: int, end: int) -> Span:
    """Return the span between two offsets of a text, in code points."""
    span = _new(Span)
    _set_offsets(span, (whole, begin, end))
    return span


def offsets_of(span: Span) -> tuple[int, int] | None:
    """Return the two offsets that a span was made of, None where it was made of lines and columns."""
    offsets: tuple[Whole, int, int] | None = getattr(span, "_offsets", None)
    return None if offsets is None else offsets[1:]


def whole_of(span: Span) -> Whole | None:
    """Return the text that a span was made in by offsets, None where it was made of lines and columns."""
    offsets: tuple[Whole, int, int] | None = getattr(span, "_offsets", None)
    return None if offsets is None else offsets[0]


def all_of(span: Span) -> tuple[str, int, int, int, int]:
    """Return all fields of a span; of one that is given by offsets they are not kept."""
    offsets: tuple[Whole, int, int] | None = getattr(span, "_offsets", None)
    if offsets is None:
        return span.file, span.line, span.column, span.end_line, span.end_column
    whole, begin, end = offsets
    return (whole.file, *whole.place(begin), *whole.place(end))


def stretches(span: Span, skipped: int = 0) -> Callable[[int, int], Span]:
    """Return what gives parts of a span that was made of offsets, by offsets from so far behind its beginning."""
    whole, begin, _ = span._offsets  # type: ignore[attr-defined] # noqa: SLF001 - its own module
    begin += skipped

    def part(first: int, last: int) -> Span:
        span = _new(Span)
        _set_offsets(span, (whole, begin + first, begin + last))
        return span

    return part


def is_within(part: Span, whole: Span) -> bool:
    """Return whether a range of text is part of another one, or all of it."""
    begin, end = (part.line, part.column), (part.end_line, part.end_column)
    around = (whole.line, whole.column), (whole.end_line, whole.end_column)
    return part.file == whole.file and around[0] <= begin and end <= around[1]


def meet(one: Span, other: Span) -> bool:
    """Return whether two ranges of text have a place in common, be it an end."""
    ends = (one.end_line, one.end_column), (other.end_line, other.end_column)
    begins = (one.line, one.column), (other.line, other.column)
    return one.file == other.file and begins[0] <= ends[1] and begins[1] <= ends[0]


def inside(span: Span, first: int, last: int) -> Span:
    """Return a part of a span that was made of offsets, by offsets from its beginning."""
    whole, begin, _ = span._offsets  # type: ignore[attr-defined] # noqa: SLF001 - its own module
    return stretch(whole, begin + first, begin + last)


_END: Final = 4
_BOTH_ENDS: Final = 2 * _END


@dataclass(frozen=True, slots=True)
class Location:
    """A span, and the include actions that led to its file, innermost first."""

    span: Span
    included_from: tuple[Span, ...] = ()

    def __hash__(self) -> int:
        """Return the same for equal ones, at a cost that does not grow with the depth of the includes."""
        chain = self.included_from
        return hash((self.span, chain if len(chain) <= _BOTH_ENDS else (*chain[:_END], *chain[-_END:])))

    def __str__(self) -> str:
        return str(self.span)


class Matched:
    """A text that an expression has matched as a whole: what stands in it has the places of the groups.

    These are worked out when somebody asks for one, which is then the same object each time.
    """

    __slots__ = ("_match", "_spans", "whole")

    def __init__(self, whole: Whole, match: re.Match[str]) -> None:
        self.whole = whole
        self._match = match
        self._spans: dict[int, Span] = {}

    def span(self, group: int) -> Span:
        """Return the place of a group."""
        span = self._spans.get(group)
        if span is None:
            begin, end = self._match.span(group)
            span = self._spans[group] = stretch(self.whole, begin, end)
        return span


GROUPS: Final = 4  # bits of a number that tell a group


class Places(Matched):
    """A text of which expressions have matched one part after the other: what stands in it has numbers.

    A number tells the match, and in its last bits the group; some places are told by two offsets instead.
    """

    __slots__ = ("told",)

    def __init__(self, whole: Whole, told: list[re.Match[str] | tuple[int, int]]) -> None:
        self.whole = whole
        self._spans = {}
        self.told = told

    def add(self, place: re.Match[str] | tuple[int, int]) -> int:
        """Add a match, or a place; return its number, of a match with no bit of a group."""
        told = self.told
        told.append(place)
        return len(told) - 1 << GROUPS

    def span(self, group: int) -> Span:
        """Return the place with a number."""
        span = self._spans.get(group)
        if span is None:
            told = self.told[group >> GROUPS]
            begin, end = told if isinstance(told, tuple) else told.span(group & _GROUP)
            span = self._spans[group] = stretch(self.whole, begin, end)
        return span


_GROUP: Final = (1 << GROUPS) - 1


class LocationOfGroup(Location):
    """The location of a group in a text that was matched; equal to any other one that says the same."""

    __slots__ = ("group", "matched")

    matched: Matched
    group: int

    def __new__(cls, span: Span, included_from: tuple[Span, ...] = ()) -> Location:  # type: ignore[misc]
        """Return an ordinary location: what is made of it with a change has a place of its own."""
        return Location(span, included_from)

    @property
    def span(self) -> Span:
        """The place."""
        return self.matched.span(self.group)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Location):
            return NotImplemented
        if isinstance(other, LocationOfGroup) and other.matched.whole is self.matched.whole:
            same = offsets_of(self.span) == offsets_of(other.span)
        else:
            same = self.span == other.span
        return same and self.included_from == other.included_from

    __hash__ = Location.__hash__

    def __repr__(self) -> str:
        return repr(Location(self.span, self.included_from))

    def __reduce__(self) -> tuple[type[Location], tuple[Span, tuple[Span, ...]]]:
        return Location, (self.span, self.included_from)


def location_of(matched: Matched, group: int, included_from: tuple[Span, ...]) -> Location:
    """Return the location of a group."""
    location: Any = _new(LocationOfGroup)
    location.included_from = included_from
    location.matched = matched
    location.group = group
    made: Location = location
    return made


# With this, locations of groups refuse no field either.
new_location = maker(Location)
new_span = maker(Span)


def point(file: str, line: int = 1, column: int = 1) -> Span:
    """Return the empty span at one place."""
    return Span(file, line, column, line, column)


def is_python(place: Span | Location) -> bool:
    """Return whether a place is in a Python file: strictness that files of others cannot stand ends there.

    Most launch files that exist are in Python; what upstream lets pass in them is told, not refused.
    """
    if type(place) is LocationOfGroup:
        return place.matched.whole.file.endswith(".py")
    span = place.span if isinstance(place, Location) else place
    return span.file.endswith(".py")


def displayed(path: str, real: Callable[[str], str] = os.path.realpath) -> str:
    """Return the path as it is shown to people: relative where it is below the working directory.

    `real` tells where a path leads to.
    """
    try:
        absolute = real(path)
    except ValueError:  # no file can have such a name, as one with NUL
        return path
    # The working directory is told as it is really called (getcwd(3)).
    prefix = os.path.join(os.getcwd(), "")  # noqa: PTH118, PTH109 - pathlib is slow to import
    return absolute.removeprefix(prefix)


def is_file(path: str | os.PathLike[str]) -> bool:
    """Return whether a file can be seen there; a path that the system refuses (too long, no permission) is none."""
    return os.path.isfile(path)  # noqa: PTH113 - pathlib raises for such paths
