"""Where an error of syntax stands, in code points.

CPython counts columns in bytes up to 3.12 where it reads bytes, and always in what its compiler finds after parsing.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.compat.columns import code_points
from orchestra.compat.place import shown
from orchestra.location import Span

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

# What is written for the `=` of an argument with a name: `name == 'a'`, `name: 'a'`.
_SIGN: Final = re.compile(r"([A-Za-z_]\w*)\s*(==|:=?|=>)")
# How CPython tells of what may follow from a bracket that is missing.
_OF_BRACKETS: Final = (
    "'",
    "cannot assign",
    "closing parenthesis",
    "expected",
    "expression cannot",
    "invalid syntax",
    "positional",
)


def span_of_syntax(error: SyntaxError) -> tuple[Span, str | None, tuple[str, ...]]:
    """Return the range of the text that is wrong, one character at least, what should stand there, and notes."""
    import linecache  # noqa: PLC0415 - slow, and of no use to launch files in YAML and XML

    file = str(error.filename)
    line, column = error.lineno or 1, max(error.offset or 1, 1)
    end_line, end_column = error.end_lineno or line, error.end_offset or 0
    text = linecache.getline(file, line).rstrip("\n")
    if isinstance(error, IndentationError):
        column = len(text) - len(text.lstrip()) + 1
    elif not text.isascii():
        column, end_column = _in_code_points(error, file, (line, column, end_line, end_column))
    if end_line == line:
        end_column = min(end_column, len(text) + 1)
    if (end_line, end_column) <= (line, column):
        end_line, end_column = line, column + (column <= len(text))
    # Here, because only mistakes need them.
    from orchestra.compat.missing_commas import narrowed  # noqa: PLC0415
    from orchestra.compat.slips_of_syntax import slip_in  # noqa: PLC0415

    lines = linecache.getlines(file)
    slip = slip_in(error, lines)
    if slip is not None:
        return Span(shown(file), line, slip[0] + 1, line, slip[1] + 1), slip[2], ()
    return _without_bracket(error, lines) or (
        *narrowed(error, Span(shown(file), line, column, end_line, end_column), lines),
        (),
    )


def _without_bracket(
    error: SyntaxError, lines: Sequence[str]
) -> tuple[Span, str | None, tuple[str, ...]] | None:
    """Return where a bracket lacks the one that closes it, where that is all that is wrong."""
    # Here, because only mistakes need them.
    from orchestra.compat.missing_brackets import bracket_missing  # noqa: PLC0415
    from orchestra.compat.slips_of_syntax import other_bracket  # noqa: PLC0415
    from orchestra.compat.unnamed_arguments import unnamed_argument  # noqa: PLC0415

    source = "".join(lines)
    if "positional argument follows" in str(error.msg):
        offset = sum(map(len, lines[: (error.lineno or 1) - 1])) + max((error.offset or 1) - 1, 0)
        argument = unnamed_argument(source, offset)
        sign = None if argument is None else _SIGN.match(source[slice(*argument)])
        if argument is not None and sign is not None:
            return _span(error, source, argument[0] + sign.start(2), argument[0] + sign.end(2)), "=", ()
        if argument is not None:
            return _span(error, source, *argument), None, ()
    if not str(error.msg).startswith(_OF_BRACKETS):
        return None
    found = bracket_missing(source)
    if found is None:
        slip, line = other_bracket(error, lines), error.lineno or 1
        span = (
            None if slip is None else Span(shown(str(error.filename)), line, slip[0] + 1, line, slip[1] + 1)
        )
        return None if slip is None or span is None else (span, slip[2], ())
    begin, end, meant, notes = found
    if source[begin] in "([{":
        error.msg = f"'{source[begin]}' was never closed"
    return _span(error, source, begin, end), meant, notes


def _span(error: SyntaxError, source: str, begin: int, end: int) -> Span:
    places = [(source.count("\n", 0, at) + 1, at - source.rfind("\n", 0, at)) for at in (begin, end)]
    return Span(shown(str(error.filename)), *places[0], *places[1])


def _in_code_points(error: SyntaxError, file: str, given: tuple[int, int, int, int]) -> tuple[int, int]:
    """Return first and last column: as of the text where that cannot be parsed, else converted."""
    line, column, end_line, end_column = given
    import linecache  # noqa: PLC0415 - as above

    source = "".join(linecache.getlines(file))
    try:
        compile(source, file, "exec", dont_inherit=True)
    except SyntaxError as told:
        if (told.lineno, told.msg) != (error.lineno, error.msg):
            return column, end_column
        if told.offset != error.offset or told.end_offset != error.end_offset or not _parses(source):
            return max(told.offset or 1, 1), told.end_offset or 0
    return code_points(file, line, column - 1) + 1, code_points(file, end_line, max(end_column - 1, 0)) + 1


def _parses(source: str) -> bool:
    # Here, because only mistakes need it.
    from ast import parse  # noqa: PLC0415

    parsing: Callable[[str], object] = parse
    try:
        parsing(source)
    except SyntaxError:
        return False
    return True
