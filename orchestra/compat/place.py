"""Where in the user's files an object was made: the innermost line that is not Orchestra's own."""

from __future__ import annotations

import os
import sys
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.location import FIELDS, Matched, Span, displayed, stretch
from orchestra.witness.once import real

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import CodeType, FrameType

# What is known of codes; a code that is kept keeps its id.
_known: dict[int, Instructions] = {}
_MOST_CODES: Final = 256
# How files are shown of which that has been found out.
_names: dict[str, str] = {}
# Where everything stands that is made now, whoever makes it.
stands: list[Place] = []
# What code of a launch file constructs now, and the frame of that code.
NOBODY: Final = (None, None)
called: list[tuple[Any, FrameType | None]] = [NOBODY]
_OWN = os.path.join(os.path.dirname(os.path.dirname(__file__)), "")  # noqa: PTH118, PTH120 - compared with file names of code
OURS: Final = f"{__name__.partition('.')[0]}."
# How deep whoever calls a constructor stands below `here`: above are ours, that and what reports wrong arguments.
IN_CONSTRUCTOR: Final = 3
_Positions: TypeAlias = tuple[int | None, int | None, int | None, int | None]


class Key(int):
    """The name in an entry of a dictionary, or in one of several pairs, by the entry's number: it ends a path."""


class ValueOf(int):
    """The value in such an entry."""


@dataclass(frozen=True, slots=True)
class Letters:
    """Some letters, from `begin` to `end`, of one of the texts that an argument is made of: it ends a path."""

    text: str
    begin: int
    end: int


Step: TypeAlias = str | int
Way: TypeAlias = Step | Letters  # what may end a path


class Place:
    """A point in the user's code, whose span few ask for; `kind` is the class of what was made there, if anything."""

    __slots__ = ("_code", "_instruction", "_span", "kind")

    def __init__(self, code: CodeType, instruction: int, kind: type[Any] | None = None) -> None:
        self._code = code
        self._instruction = instruction
        self._span: Span | None = None
        self.kind = kind

    @property
    def file(self) -> str:
        """The file, as its code names it."""
        return self._code.co_filename

    @property
    def span(self) -> Span:
        """The range of the expression."""
        if self._span is None:
            self._span = span_of(self._code, self._instruction)
        return self._span

    @property
    def whole(self) -> Instructions:
        """The code, as the text in which it stands; another object each time."""
        return Instructions(self._code)

    def of(self, made: object) -> Place:
        """Return the same place as that of what was made there."""
        return Place(self._code, self._instruction, None if made is None else type(made))

    def at(self, *path: Way) -> Argument:
        """Return the place of an argument of the call, or of what it holds: a keyword, then keys and indexes."""
        return argument(self, path)


@dataclass(frozen=True, slots=True)
class Argument(Span):
    """The range of a call, and which of its arguments is meant: `orchestra.compat.literals` finds it in the source.

    That takes a syntax tree, so that it is done for what people are told of, not for every value. The range itself is
    asked for when somebody reads it.
    """

    path: tuple[Way, ...]
    place: Place = field(compare=False, repr=False)

    if not TYPE_CHECKING:  # as in a span

        def __getattr__(self, name: str) -> str | int:
            if name not in FIELDS:
                raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
            span = self.place.span
            if name == "file":  # as in a span
                object.__setattr__(self, name, span.file)
                return span.file
            for known in FIELDS:
                object.__setattr__(self, known, getattr(span, known))
            return getattr(span, name)

    def __eq__(self, other: object) -> bool:
        """Tell whether the other one is the same argument in the same place, which is seldom worked out for that."""
        if not isinstance(other, Argument):
            return NotImplemented
        if self.path != other.path:
            return False
        return self.place is other.place or self.place.span == other.place.span

    def __hash__(self) -> int:
        return hash((self.place.span, self.path))

    def __deepcopy__(self, memo: object) -> Argument:
        """Return the same: nobody changes it, and what is made of a span has no path."""
        return self

    def inside(self, *steps: Way) -> Argument:
        """Return the place of something that the argument holds."""
        return self.place.at(*self.path, *steps)


class Arguments(Matched):
    """The arguments of a call: what they hold has a place by its path, which is made when somebody asks for it."""

    __slots__ = ("place",)

    def __init__(self, place: Place) -> None:
        self.place = place

    if not TYPE_CHECKING:  # else any attribute would be one

        def __getattr__(self, name: str) -> Any:
            """Return the places that are known, none at first: few calls are ever asked for one."""
            if name == "_spans":
                self._spans = {}
                return self._spans
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")

    @property
    def whole(self) -> Instructions:  # type: ignore[override] # nobody sets it
        """The text, another object each time: two arguments of a call have no offsets to be told apart by."""
        return self.place.whole

    def span(self, group: Any) -> Span:
        """Return the place of an argument, or of what it holds, by its path; of all of the call without one."""
        span = self._spans.get(group)
        if span is None:
            span = self._spans[group] = argument(self.place, group) if group else self.place.span
        return span


_new = object.__new__
_set_path: Callable[[Argument, tuple[Way, ...]], None] = vars(Argument)["path"].__set__
_set_place: Callable[[Argument, Place], None] = vars(Argument)["place"].__set__


def argument(place: Place, path: tuple[Way, ...]) -> Argument:
    """Return the place of an argument of the call at a place, or of what it holds."""
    made = _new(Argument)
    _set_path(made, path)
    _set_place(made, place)
    return made


def within(span: Span, *steps: Way) -> Span:
    """Return the place of something inside of what is at a place, where it is known which argument that is."""
    return span.inside(*steps) if isinstance(span, Argument) else span


def here(made: object = None, depth: int = 1) -> Place:
    """Return the place in the user's code that led to this call: where `made` was made, by whatever subclass."""
    if stands:
        return stands[-1].of(made)
    known, caller = called[0]
    if known is made and caller is not None:
        code = caller.f_code
        if code.co_name != "__init__" and not code.co_filename.startswith(_OWN):
            return Place(code, caller.f_lasti, type(made))
    frame: FrameType | None = sys._getframe(depth)
    while frame is not None:
        found = frame
        name = frame.f_globals.get("__name__")  # as `is_ours` does, without a call for each frame
        if type(name) is not str or not name.startswith(OURS):
            code = frame.f_code
            if not code.co_filename.startswith(_OWN) and not _is_constructor(frame, code, made):
                break
        frame = frame.f_back
    else:
        code = found.f_code
    return Place(code, found.f_lasti, None if made is None else type(made))


def _is_constructor(frame: FrameType, code: CodeType, made: object) -> bool:
    """Return whether a frame is a subclass's `__init__` of an object."""
    return code.co_name == "__init__" and frame.f_locals.get(code.co_varnames[0]) is made


def is_ours(frame: FrameType) -> bool:
    """Return whether what runs in a frame is part of Orchestra itself."""
    # Its code is asked for only where its module does not tell: a process that is watched hears of that each time.
    name = frame.f_globals.get("__name__")
    return name.startswith(OURS) if type(name) is str else is_own(frame.f_code.co_filename)


def is_own(file: str) -> bool:
    """Return whether a file is part of Orchestra itself."""
    return file.startswith(_OWN)


def span_of(code: CodeType, instruction: int) -> Span:
    """Return the range of source text of an instruction; columns are counted in code points."""
    known = _known.get(id(code))
    if known is None:
        if len(_known) >= _MOST_CODES:
            _known.clear()
        known = _known[id(code)] = Instructions(code)
    return stretch(known, 2 * instruction, 2 * instruction + 1)


def forget() -> None:
    """Forget how files are shown: the working directory may be another one than before."""
    _known.clear()
    _names.clear()


class Instructions:
    """The instructions of a code, as a text in which two offsets each are where one begins and where it ends.

    The positions are unpacked once, for there is no way to one of them.
    """

    __slots__ = ("_code", "_file", "_positions")

    def __init__(self, code: CodeType) -> None:
        self._code = code
        self._file: str | None = None
        self._positions: list[_Positions] | None = None

    @property
    def file(self) -> str:
        """The file, as it is shown to people."""
        self._file = self._file or shown(self._code.co_filename)
        return self._file

    def place(self, offset: int) -> tuple[int, int]:
        """Return line and column."""
        instruction, end = divmod(offset, 2)
        span = span_in(self._code.co_filename, self._at(instruction // 2))
        return (span.end_line, span.end_column) if end else (span.line, span.column)

    def _at(self, index: int) -> _Positions:
        self._positions = self._positions or list(self._code.co_positions())
        known = self._positions[index] if index < len(self._positions) else (None, None, None, None)
        return (known[0] or self._code.co_firstlineno, *known[1:])


def span_in(file: str, positions: _Positions) -> Span:
    """Return the range of source text between a line, an end line, and columns in bytes as the compiler counts."""
    line, end_line, column, end_column = positions
    line = line or 1
    if column is None or end_column is None or end_line is None:
        return Span(shown(file), line, 1, line, 1)
    from orchestra.compat.columns import code_points  # noqa: PLC0415 - launch files in YAML and XML have no use for it

    begin = code_points(file, line, column)
    return Span(shown(file), line, begin + 1, end_line, code_points(file, end_line, end_column) + 1)


def show(file: str, name: str) -> None:
    """Let a source file be shown to people by a name, until it is forgotten."""
    _names[file] = name


def shown(file: str) -> str:
    """Return a source file as people see it."""
    return _names.get(file) or _shown(file, os.getcwd())  # noqa: PTH109 - no path is wanted


@lru_cache(maxsize=4096)
def _shown(file: str, _working_directory: str) -> str:
    return displayed(file, real)
