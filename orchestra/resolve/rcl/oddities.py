"""What rcl takes and hardly anybody means: names that no node declares, numbers with units, lists within a text.

Told of a unit is only where the same parameter of another node in the file is a number: most texts that look like
numbers with units are texts.
"""

from __future__ import annotations

from types import NoneType
from typing import TYPE_CHECKING, Final

from orchestra.description.source import shortened
from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.patterns import pattern
from orchestra.resolve.rcl.listed import report_shallow, report_unlisted
from orchestra.resolve.rcl.odd_names import may_be_odd, odd_name

if TYPE_CHECKING:
    import re
    from collections.abc import Sequence

    from orchestra.errors import Problems
    from orchestra.location import Location
    from orchestra.resolve.rcl.sections import Entry, Section

_UNIT: Final = pattern(
    r"([-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)\s?"
    r"(?:deg|degrees?|rad|m|cm|mm|km|s|sec|ms|us|ns|min|k?Hz|M[Hh]z|hz|m/s|rad/s|deg/s|m/s\^?2|kg|g|N|Nm|V|A|W|Ah|%|°)"
)
# Neither leaves open where a part of it ends: a text takes time in proportion to its length.
_NUMBERS: Final = pattern(r"{0}(?:\s+{0})+".format(r"[-+]?(?:[0-9]+(?:\.[0-9]+)?|\.[0-9]+)"))
_NAMES: Final = pattern(r"[A-Za-z]\w*(?: +[A-Za-z]\w*)+")
_TAG: Final = pattern(r"!\S*")
_KINDS: Final = {"!!str": str, "!!int": int, "!!float": float, "!!bool": bool, "!!seq": tuple}
# What a float does not keep: digits around an `e`, a zero behind all others; and names of what is no quantity.
_IN_DIGITS: Final = pattern(r"[0-9]+[eE][0-9]+|[0-9]+\.[0-9]*[1-9]0+")
_NAMING: Final = pattern(
    r"(?:^|[_.])"
    r"(?:batch|checksum|commit|digest|guid|hash|lot|mac|password|release|revision|serial|sha|token|uid|uuid|version)"
    r"(?:$|_)|(?:^|[_.])(?:code|id|label|model|name|sn|tag)$"
)
_DASHED: Final = pattern(r"-[A-Za-z_/]")
_AN_ITEM: Final = pattern(r"-[\sA-Za-z_/]")
_ITEM: Final = pattern(r"\s*(-\s\S*(?:\s+\S+)*)\s*")


def report_oddities(sections: Sequence[Section], lines: Sequence[str], problems: Problems) -> None:
    """Report such names and values in the lines of a file."""
    numbers: set[str] | None = None
    tagged = any("!" in line for line in lines)
    report_unlisted(sections, problems)
    report_shallow(sections, problems)
    for section in sections:
        for entry in section.entries:
            if entry.value is not None and may_be_odd(entry.name):
                _report_name(entry, lines, problems)
            if tagged and entry.value is not None:
                _report_tag(entry, lines, problems)
            if isinstance(entry.value, str):
                if (found := _unit(entry.value)) is not None:
                    numbers = _numbers(sections) if numbers is None else numbers
                    _report_unit(entry, found, numbers, problems)
                _report_items(entry.location, entry.value, lines, problems)
            elif isinstance(entry.value, float):
                _report_lost(entry, lines, problems)
            elif isinstance(entry.value, tuple):
                _report_list(entry, lines, problems)


def _report_name(entry: Entry, lines: Sequence[str], problems: Problems) -> None:
    """Report a name as no node declares it; that of a level above it is left alone."""
    key = _text_at(entry.key, lines).strip("\"'")
    found = odd_name(key)
    if found is not None and (key == entry.name or " " in key):
        message = f"no node declares '{shortened(key)}': {found[0]}"
        problems.warning(Code.SURPRISING_SCALAR, message, entry.key, suggestion=found[1])


def _report_tag(entry: Entry, lines: Sequence[str], problems: Problems) -> None:
    """Report a tag that says something else than the type that the value has: to rcl only `!!str` says something."""
    found = _TAG.match(_text_at(entry.location, lines))
    if found is None or isinstance(entry.value, _KINDS.get(found[0], NoneType)):
        return
    span = entry.location.span
    place = replace(span, end_line=span.line, end_column=span.column + len(found[0]))
    read = "a list" if isinstance(entry.value, tuple) else repr(entry.value)
    told = f"the tag {found[0]} says nothing to rcl, which reads {read}"
    problems.warning(Code.SURPRISING_SCALAR, told, replace(entry.location, span=place))


def _unit(text: str) -> re.Match[str] | None:
    return _UNIT.fullmatch(text) if text[:1] in "+-.0123456789" else None


def _numbers(sections: Sequence[Section]) -> set[str]:
    """Return the names of parameters that are a number somewhere."""
    return {
        entry.name
        for section in sections
        for entry in section.entries
        if isinstance(entry.value, int | float) and not isinstance(entry.value, bool)
    }


def _report_unit(entry: Entry, found: re.Match[str], numbers: set[str], problems: Problems) -> None:
    if entry.name in numbers:
        told = f"'{found[0]}' is a text: a number has no unit"
        problems.warning(Code.SURPRISING_SCALAR, told, entry.location, suggestion=found[1])


def _report_lost(entry: Entry, lines: Sequence[str], problems: Problems) -> None:
    """Report what looks like a number and names something: the float that it is read as does not say it any more."""
    text = _text_at(entry.location, lines)
    if _IN_DIGITS.fullmatch(text) and is_of_name(entry.name):
        told = f"'{text}' is read as the float {entry.value}: a text is written \"{text}\""
        problems.warning(Code.SURPRISING_SCALAR, told, entry.location, suggestion=f'"{text}"')


def is_of_name(name: str) -> bool:
    """Return whether what a parameter of this name has is a name of something, and no quantity."""
    return _NAMING.search(name) is not None


def _report_list(entry: Entry, lines: Sequence[str], problems: Problems) -> None:
    _report_blanks(entry, lines, problems)
    for value, at in zip(entry.value if isinstance(entry.value, tuple) else (), entry.items, strict=False):
        if isinstance(value, str):
            _report_items(at, value, lines, problems)


def _report_blanks(entry: Entry, lines: Sequence[str], problems: Problems) -> None:
    """Report what stands in brackets without commas, as `[0.5 0.3]` or `[map_server amcl]`: a list of one text."""
    text = entry.value[0] if isinstance(entry.value, tuple) and len(entry.items) == 1 else None
    if not isinstance(text, str) or " " not in text:
        return
    quoted = _text_at(entry.items[0], lines)[:1] in ("'", '"')
    names = not quoted and "_" in text and _NAMES.fullmatch(text) and _is_in_brackets(entry, lines)
    if names or (_NUMBERS.fullmatch(text) and ("." in text or not quoted)):
        told = f"'{shortened(text)}' is one text: commas stand between the items of a list"
        at, instead = entry.items[0], ", ".join(text.split())
        problems.warning(Code.SURPRISING_SCALAR, told, at, suggestion=instead)


def _is_in_brackets(entry: Entry, lines: Sequence[str]) -> bool:
    return _text_at(entry.location, lines)[:1] == "["


def _report_items(at: Location, value: str, lines: Sequence[str], problems: Problems) -> None:
    """Report a line of a plain text that is an item of a list but for its indentation."""
    span = at.span
    if span.line == span.end_line or " -" not in value or _text_at(at, lines)[:1] in ("'", '"', "|", ">"):
        return
    first = _text_at(at, lines)
    others = [line.lstrip() for line in lines[span.line : span.end_line] if line.strip()]
    if _DASHED.match(first) and all(map(_AN_ITEM.match, others)):
        place = replace(span, end_line=span.line, end_column=span.column + len(first.rstrip()))
        told = f"a blank is missing behind the '-' of '{shortened(first.rstrip())}'"
        instead = f"- {first[1:].rstrip()}"
        problems.warning(Code.SURPRISING_SCALAR, told, replace(at, span=place), suggestion=instead)
        return
    for number in range(span.line + 1, span.end_line + 1):
        line = lines[number - 1]
        found = _ITEM.fullmatch(line)
        if found is not None:
            place = replace(span, line=number, column=found.start(1) + 1)
            place = replace(place, end_line=number, end_column=found.end(1) + 1)
            told = f"'{shortened(found[1])}' is indented so far that it belongs to the text above it"
            problems.warning(Code.SURPRISING_SCALAR, told, replace(at, span=place))
            return


def _text_at(at: Location, lines: Sequence[str]) -> str:
    """Return what stands at a place, on its first line."""
    span = at.span
    end = span.end_column - 1 if span.line == span.end_line else None
    return lines[span.line - 1][span.column - 1 : end]
