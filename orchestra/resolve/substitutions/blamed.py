"""Which text of an expression is to blame for what evaluating it raised."""

from __future__ import annotations

import builtins
import re
from itertools import islice
from typing import TYPE_CHECKING, Final

from orchestra.compat.literals import argument
from orchestra.compat.place import Argument, Letters
from orchestra.description.text import Call, Words
from orchestra.location import Span, is_python, is_within
from orchestra.nearest import nearest
from orchestra.resolve.substitutions.operators import foreign_operator

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping
    from types import TracebackType

    from orchestra.description.text import Part, Template

_BOOLEANS: Final = ("true", "false")
_OF_ROS1: Final = re.compile(r"""\barg\(\s*(['"])(\w+)\1\s*\)""")
_CAPITAL: Final = re.compile(r"\b(?:True|False)\b")


def blamed(written: Template, text: str, error: BaseException) -> tuple[Span | None, bool]:
    """Return where the wrong part of an expression stands, which `written` came to, and whether it is written there.

    A name that is not there may be part of a value: then it stands where that is read. None where it is the whole that
    is wrong; one text of Python is marked as such.
    """
    begin, end = _range(error, text)
    operator = foreign_operator(text, error, begin, end)
    if operator is not None:
        begin, end = operator.begin, operator.end
    elif not isinstance(error, NameError | AttributeError):
        return _failed_part(written, text, (begin, end)), False
    for index, (part, first, last) in enumerate(_placed(written, text)):
        if first <= begin < last:
            if isinstance(part, Words):
                return _inside(part, begin - first, min(end, last) - first), True
            return _used_at(index, written), False
    return None, False


def stands_at(written: Template, text: str, begin: int, end: int) -> tuple[Span, str | None]:
    """Return where some characters stand of what a text came to, and what is written there where it is plain text."""
    for index, (part, first, last) in enumerate(_placed(written, text)):
        if first <= begin < last:
            if isinstance(part, Words):
                inside = part.text[begin - first : min(end, last) - first]
                return _inside(part, begin - first, min(end, last) - first), inside
            return _used_at(index, written), None
    return written.span, None


def _failed_part(written: Template, text: str, failed: tuple[int, int]) -> Span | None:
    """Return where what has failed of an expression stands, None where that is the whole of it.

    One text of Python is marked as such: what it is made of may stand anywhere.
    """
    if isinstance(written.span, Argument):
        return written.span if len(written.parts) == 1 else None
    begin, end = failed
    if not text[:begin].strip() and not text[end:].strip():
        return None
    spans = list[Span]()
    for part, first, last in _placed(written, text):
        if begin < last and first < end:
            place = (max(begin, first) - first, min(end, last) - first)
            spans.append(_inside(part, *place) if isinstance(part, Words) else part.span)
    if not spans:
        return None
    return Span(spans[0].file, spans[0].line, spans[0].column, spans[-1].end_line, spans[-1].end_column)


def _used_at(index: int, written: Template) -> Span:
    """Return where a part of an expression stands in it; in Python it may have been made elsewhere, under a name."""
    span, part = written.span, written.parts[index].span
    if not isinstance(span, Argument):
        return part
    literal = argument(span.place, span.path)
    if is_within(part, literal.whole) or not literal.holds(len(written.parts)):
        return part
    return literal.item(index, len(written.parts)).whole


def meant_by(text: str, error: BaseException, names: Mapping[str, object]) -> str | None:
    """Return the name that was meant by one that is not there: that of a function where it is called.

    `names` are those that the expression sees.
    """
    operator = foreign_operator(text, error, *_range(error, text))
    if operator is not None:
        return operator.instead
    if isinstance(error, NameError) and error.name:
        is_called = text[_range(error, text)[1] :].lstrip().startswith("(")
        known = {**vars(builtins), **names}
        return nearest(error.name, (name for name, value in known.items() if callable(value) == is_called))
    if isinstance(error, AttributeError) and error.name:
        return nearest(error.name, dir(error.obj))
    return None


def in_quotes(
    written: Template, span: Span, name: str, variables: Collection[str], file: str | None
) -> str | None:
    """Return how the text at a place is written that is a name to Python, and none that Python knows: in quotes.

    That of a variable is the variable. What comes to a boolean of the launch language is compared as a text. None where
    the whole is in single quotes, or nobody can tell; `file` is the one that it stands in.
    """
    if _quote_around(written, file) == "'":
        return None
    found = [part for part in written.parts if isinstance(part, Call) and part.span == span]
    if not found:
        return f"'$(var {name})'" if name in variables else f"'{name}'"
    words = [item.constant for item in found[0].arguments]
    if None in words or any("'" in word or '"' in word for word in words if word is not None):
        return None
    text = f"'$({' '.join(word for word in (found[0].name, *words) if word)})'"
    return f"{text} == 'true'" if name in _BOOLEANS else text


def of_ros1(written: Template, text: str, begin: Span) -> tuple[Span, str] | None:
    """Return the place of `arg('name')`, which was an argument in ROS 1, and how it is written; None for any other."""
    for part, first, _ in _placed(written, text):
        if not isinstance(part, Words):
            continue
        for found in _OF_ROS1.finditer(text, first, first + len(part.text)):
            at = _inside(part, found.start() - first, found.end() - first)
            if (at.line, at.column) == (begin.line, begin.column):
                return at, f"{found[1]}$(var {found[2]}){found[1]}"
    return None


def of_booleans(written: Template, name: str) -> str | None:
    """Return the substitutions that an expression on `true` and `false` was meant to be, which Python does not know.

    None where it is none of those that have a substitution, and for one of Python.
    """
    if name not in _BOOLEANS or is_python(written.span):
        return None
    # Here, because only mistakes need it.
    from orchestra.load.expressions import as_substitutions  # noqa: PLC0415

    whole = as_substitutions(_CAPITAL.sub(lambda found: found[0].lower(), written.raw))
    if whole is not None and written.span.file.endswith(".xml"):
        whole = whole.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
    return whole


def _quote_around(written: Template, file: str | None) -> str:
    """Return the quote in which an expression stands, a single one where that cannot be seen."""
    span = written.span
    try:
        with open(file or "", encoding="utf-8-sig") as stream:  # noqa: PTH123 - pathlib is slow
            line = next(islice(stream, span.line - 1, None), "")
    except (OSError, UnicodeDecodeError):
        return "'"
    return line[span.column - 2 : span.column - 1] or "'"


def _range(error: BaseException, text: str) -> tuple[int, int]:
    """Return first and last character, the latter exclusive, of what has raised an error."""
    stripped = text.lstrip()
    before = len(text) - len(stripped)
    calls = [call for call in _calls(error.__traceback__) if call.tb_frame.f_code.co_filename == "<string>"]
    if not calls:
        return (
            _range_of_syntax(error, text, before) if isinstance(error, SyntaxError) else (before, len(text))
        )
    code = calls[0].tb_frame.f_code
    line, end_line, column, end_column = next(
        islice(code.co_positions(), calls[0].tb_lasti // 2, None), (None, None, None, None)
    )
    if line is None or end_line is None or column is None or end_column is None:
        return before, len(text)
    begin = before + _index(stripped, line, _characters(stripped, line, column))
    end = before + _index(stripped, end_line, _characters(stripped, end_line, end_column))
    name = error.name if isinstance(error, AttributeError) else None
    return (end - len(name) if name and text[begin:end].endswith(name) else begin), end


def _range_of_syntax(error: SyntaxError, text: str, before: int) -> tuple[int, int]:
    """Return first and last character of what cannot be read as Python; all of it where more is wanted."""
    stripped, whole = text.strip(), (before, len(text))
    if error.filename != "<string>" or not error.lineno or not error.offset:
        return whole
    begin = _index(stripped, error.lineno, error.offset - 1)
    end = _index(stripped, error.end_lineno or error.lineno, (error.end_offset or 0) - 1)
    return whole if begin >= len(stripped) else (before + begin, before + max(end, begin + 1))


def _calls(traceback: TracebackType | None) -> Iterator[TracebackType]:
    while traceback is not None:
        yield traceback
        traceback = traceback.tb_next


def _index(text: str, line: int, column: int) -> int:
    return sum(len(before) for before in text.splitlines(keepends=True)[: line - 1]) + column


def _characters(text: str, line: int, column: int) -> int:
    """Return a column in characters for one in bytes."""
    lines = text.splitlines()
    return len(lines[line - 1].encode()[:column].decode(errors="replace")) if line <= len(lines) else column


def _placed(written: Template, text: str) -> Iterator[tuple[Part, int, int]]:
    """Yield the parts of a template with first and last character of what they came to."""
    pattern = "".join(
        f"({re.escape(part.text)})" if isinstance(part, Words) else "(.*?)" for part in written.parts
    )
    match = re.fullmatch(pattern, text, re.DOTALL)
    for index, part in enumerate(written.parts, start=1):
        if match is not None:
            yield part, *match.span(index)


def _inside(words: Words, begin: int, end: int) -> Span:
    """Return where some characters of a text stand, the whole of it where escapes or lines are in between."""
    span = words.span
    if isinstance(span, Argument):
        return span.inside(Letters(words.text, begin, end))
    if span.line != span.end_line or span.end_column - span.column != len(words.text):
        return span
    return Span(span.file, span.line, span.column + begin, span.line, span.column + end)
