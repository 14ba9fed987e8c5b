"""Where a bracket is missing that closes another one: where the whole file reads with it.

CPython tells of the next bracket of another kind, or of the one that is open to the end of the file.
"""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING, Final

from orchestra.compat.scanned import CLOSING, signs

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from orchestra.compat.scanned import Sign

_Slip = tuple[int, int, str | None, tuple[str, ...]]  # first and last offset, what was meant, notes
_MOST: Final = 60  # places that are tried, and fewer in a long file, for each takes a pass over it
_FEWEST: Final = 4
_MOST_READ: Final = 2_000_000  # characters
_LONGEST: Final = 100  # characters of a suggestion


def bracket_missing(source: str) -> _Slip | None:
    """Return what lacks its bracket in the text of a file; None where one bracket does not mend it."""
    found = list(signs(source))
    if not found:
        return None
    last = found[-1]
    is_other = last.text in CLOSING.values() and bool(last.around)
    is_other = is_other and CLOSING[source[last.around[-1]]] != last.text
    open_at_end = (*last.around, last.offset) if last.text in CLOSING else last.around
    if not open_at_end or (last.text in CLOSING.values() and not is_other and len(open_at_end) == 1):
        return None
    if last.text in CLOSING.values() and not is_other:
        open_at_end = open_at_end[:-1]
    opening, end = open_at_end[-1], last.offset if is_other else len(source.rstrip())
    most = min(max(_MOST_READ // len(source), _FEWEST), _MOST)
    for begin, place in islice(_of_lines(source, opening, end), most):
        mended = f"{source[begin:place]}{CLOSING[source[begin]]}"
        if _reads(f"{source[:begin]}{mended}{source[place:]}"):
            return begin, place, mended, ()
    sign = CLOSING[source[opening]]
    for place in islice(_places(source, found, opening, end), most):
        if _reads(f"{source[:place]}{sign}{source[place:]}"):
            return _told(source, opening, place, sign, end if is_other else None)
    return None


def _of_lines(source: str, opening: int, end: int) -> Iterator[tuple[int, int]]:
    """Yield from where to where a bracket stands open in its own line, which ends with a comma all the same."""
    begin = source.rfind("\n", 0, opening) + 1
    for line in source[begin:end].splitlines(keepends=True)[:_MOST]:
        inside = list(signs(line))
        around = inside[-1].around if inside and inside[-1].text not in CLOSING else ()
        content = line.rstrip().removesuffix(",")
        if len(around) == 1 and line.rstrip().endswith(",") and around[0] + 1 < len(content):
            yield begin + around[0], begin + len(content)
        begin += len(line)


def _places(source: str, found: list[Sign], opening: int, end: int) -> Iterator[int]:
    """Yield where the bracket may be missing, the last place first: at the end, before commas, at ends of lines."""
    limit = _end_of_statement(source, opening, end)
    line = source[opening : source.find("\n", opening) % (len(source) + 1)].rstrip()
    if source[opening] != "[" and len(line) > 1:  # what begins beside the bracket often ends in the same line
        yield opening + len(line.rstrip(",:"))
    if limit == end:
        yield _indented(source, opening, end)
    for sign in reversed(found):
        if opening < sign.offset <= limit and sign.around[-1:] == (opening,) and sign.text in ",\n":
            before = source[: sign.offset].rstrip()
            if len(before) > opening + 1 and before[-1:] not in ",([{":
                yield len(before)
    yield opening + 1


def _indented(source: str, opening: int, end: int) -> int:
    """Return the end, or that of the line before where what follows stands further out than the bracket."""
    begins = [source.rfind("\n", 0, place) + 1 for place in (opening, end)]
    is_first = not source[begins[1] : end].strip()
    if is_first and _indentation(source[begins[1] :]) < _indentation(source[begins[0] :]):
        return len(source[:end].rstrip().removesuffix(","))
    return end


def _end_of_statement(source: str, opening: int, end: int) -> int:
    """Return where a statement ends for people: before a line that is indented no more than its own, and goes on."""
    begin = source.rfind("\n", 0, opening) + 1
    indentation = _indentation(source[begin:])
    place = source.find("\n", opening)
    while 0 <= place < end:
        line = source[place + 1 : source.find("\n", place + 1) % (len(source) + 1)]
        if line.strip() and _indentation(line) <= indentation and line.strip()[0] not in ")]}#":
            return place
        place = source.find("\n", place + 1)
    return end


def _indentation(text: str) -> int:
    return len(text) - len(text.lstrip(" \t"))


def _told(source: str, opening: int, place: int, sign: str, other: int | None) -> _Slip:
    """Return what to tell: all from the one bracket to the other where that is one short line."""
    whole = f"{source[opening:place]}{sign}"
    if "\n" not in whole and len(whole) <= _LONGEST:
        return opening, place, whole, ()
    if place == other:
        return place, place + 1, f"{sign}{source[place]}", ()
    line = source.count("\n", 0, place) + 1
    column = place - source.rfind("\n", 0, place)
    return opening, opening + 1, None, (f"'{sign}' is missing at line {line}, column {column}",)


def _reads(source: str) -> bool:
    # Here, because only mistakes need it.
    from ast import parse  # noqa: PLC0415

    parsing: Callable[[str], object] = parse
    try:
        parsing(source)
    except (SyntaxError, ValueError):
        return False
    return True
