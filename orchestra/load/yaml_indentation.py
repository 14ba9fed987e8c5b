"""Faults of a YAML text that are matters of lines: an item without its dash, a line that is indented as no other.

The parser stops where nothing fits any more, which is often behind the line that is wrong: of two ways to read the
lines around, that counts by which a single one is wrong.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from orchestra.load.faults import Fault
    from orchestra.load.yaml_failure import Failure

_UNSPACED: Final = re.compile(r"-([A-Za-z][\w-]*)\s*:")
_KEY: Final = re.compile(r"([\w./~*-]+)\s*:(?:\s|$)")
_BRACKETED: Final = re.compile(r"(?:- )?([\w/~][\w./~*-]*) [\[{]")


@dataclass(frozen=True, slots=True)
class _Line:
    """A line with something on it: its offset, its indentation, and what it says."""

    begin: int
    indent: int
    text: str

    @property
    def is_item(self) -> bool:
        """Whether an item of a list begins here."""
        return self.text.startswith("- ") or self.text == "-"


def of_lines(failure: Failure) -> Fault | None:
    """Return the fault of a line that is wrong by its beginning, None where no line plainly is."""
    lines, here = _lines(failure)
    if not lines or here is None:
        return None
    above, below = lines[:here], lines[here:]
    return (
        _bracketed(failure, lines[max(0, here - 1) : here + 1])
        or _unspaced(failure, above, lines[here])
        or _first_indented(failure, above, lines[here])
        or _undashed(failure, above, below)
        or _shifted(failure, above, below)
    )


def _lines(failure: Failure) -> tuple[list[_Line], int | None]:
    """Return the lines that are neither empty nor comments, and which of them the parser gave up in."""
    found: list[_Line] = []
    here = None
    starts = failure.whole.lines
    for number, begin in enumerate(starts, 1):
        end = starts[number] if number < len(starts) else len(failure.text)
        whole = failure.text[begin:end]
        text = whole.strip()
        if not text or text.startswith("#"):
            continue
        if begin <= failure.at < max(end, begin + 1):
            here = len(found)
        found.append(_Line(begin, len(whole) - len(whole.lstrip(" ")), text))
    return found, here


def _bracketed(failure: Failure, lines: list[_Line]) -> Fault | None:
    """Explain a key with a mapping or list in brackets behind it, and no colon between them."""
    for line in lines:
        found = _BRACKETED.match(line.text)
        if found is not None and failure.line_of(line.begin) == failure.line_of(failure.at):
            begin = line.begin + line.indent + found.start(1)
            end = begin + len(found[1])
            return failure.fault(f"a ':' is missing behind '{found[1]}'", begin, end, f"{found[1]}:")
    return None


def _unspaced(failure: Failure, above: list[_Line], line: _Line) -> Fault | None:
    """Explain an item whose dash lacks its blank: it reads as a key, and the items behind it fit nowhere."""
    if not line.is_item:
        return None
    for other in reversed(above):
        if other.indent < line.indent or (other.indent == line.indent and other.is_item):
            return None
        found = _UNSPACED.match(other.text)
        if other.indent == line.indent and found is not None:
            begin = other.begin + other.indent
            message = f"a blank is missing behind the '-' of '-{found[1]}'"
            return failure.fault(message, begin, begin + 1 + len(found[1]), f"- {found[1]}")
    return None


def _first_indented(failure: Failure, above: list[_Line], line: _Line) -> Fault | None:
    """Explain a file whose first line is indented, and nothing behind it is."""
    if not above or line.indent > 0 or above[0].indent == 0 or any(item.indent == 0 for item in above):
        return None
    return _of_word(failure, above[0], "this is indented, and what comes below it is not")


def _undashed(failure: Failure, above: list[_Line], below: list[_Line]) -> Fault | None:
    """Explain a first item that lacks its dash: those behind it have theirs."""
    line = below[0]
    parent = next(
        (
            at
            for at in reversed(range(len(above)))
            if above[at].indent < line.indent or _opens(above[at], line)
        ),
        None,
    )
    if not line.is_item or parent is None or parent + 1 >= len(above):
        return None
    first = above[parent + 1]
    siblings = [item for item in _block(below, line.indent) if item.indent == line.indent]
    listed = _opens(above[parent], line) or (len(siblings) > 1 and _opens(above[parent], above[parent]))
    if first.is_item or not listed or _KEY.match(first.text) is None:
        return None
    begin = first.begin + first.indent
    word = first.text.partition(":")[0]
    message = "an item of the list begins with '- '"
    return failure.fault(message, begin, begin + len(word), f"- {word}")


def _opens(line: _Line, item: _Line) -> bool:
    """Return whether a line is the key of the list in which an item stands that is indented like it."""
    return line.indent == item.indent and not line.is_item and line.text.endswith(":")


def _shifted(failure: Failure, above: list[_Line], below: list[_Line]) -> Fault | None:
    """Explain a single line before others that are indented otherwise: it is wrong where they are more, or as usual."""
    line = below[0]
    others = sum(1 for item in _block(below, line.indent) if item.indent == line.indent)
    before = _before(above, line)
    alike = [item for item in before if item.indent == before[0].indent]
    if len(alike) != 1 or (others == 1 and not _is_rarer(alike[0], line, [*above, *below])):
        return None
    parent = line.is_item and alike[0].text.endswith(":")
    if alike[0].is_item != line.is_item and not parent:
        return None
    how = "more" if alike[0].indent > line.indent else "less"
    return _of_word(failure, alike[0], f"this is indented {how} than what comes below it")


def _is_rarer(one: _Line, other: _Line, lines: list[_Line]) -> bool:
    """Return whether a file indents fewer lines of the same kind like one than like another."""
    indents = [line.indent for line in lines if line.is_item == other.is_item]
    return indents.count(one.indent) < indents.count(other.indent)


def _before(above: list[_Line], line: _Line) -> list[_Line]:
    """Return the lines before one that stand in the same mapping or list but for their indentation."""
    found: list[_Line] = []
    for item in reversed(above):
        if _opens(item, line) or (found and item.indent < found[0].indent):
            break
        if item.indent == line.indent:
            return []
        if not found and item.indent < line.indent and (item.is_item or item.text.endswith(":")):
            return []
        found.insert(0, item)
    return found


def _block(lines: list[_Line], indent: int) -> list[_Line]:
    """Return the lines up to the first that is indented less."""
    end = next((at for at, line in enumerate(lines) if line.indent < indent), len(lines))
    return lines[:end]


def _of_word(failure: Failure, line: _Line, message: str) -> Fault:
    begin = line.begin + line.indent
    return failure.fault(message, begin, failure.end_of_word(begin))
