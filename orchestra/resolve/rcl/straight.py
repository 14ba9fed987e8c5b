"""Parameter files that say plainly what they mean, as most do, line by line.

Whoever follows rcl event by event gives the same sections in six times as long. Here nothing is told: whatever is not
plain to see, or may have something to tell, is left to that reader.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.location import new_location, new_span
from orchestra.patterns import pattern
from orchestra.resolve.rcl.patterns import pattern_fault
from orchestra.resolve.rcl.plain_values import Unlike, named_value, value_of
from orchestra.resolve.rcl.sections import Section, new_entry
from orchestra.resolve.rcl.strays import SECTION_KEY, is_misspelt_section

if TYPE_CHECKING:
    import re
    from collections.abc import Sequence

    from orchestra.location import Location
    from orchestra.resolve.rcl.sections import Entry
    from orchestra.values import ParameterValue, Scalar

# Of ASCII, without escapes, and on one line. libyaml takes no keys of more than 1024 characters.
_SCALAR: Final = r""""[ !#-\[\]-~]*"|'[ -&(-~]*'|[\w/.-]+"""
_KEY: Final = r"[A-Za-z_/][\w/*.-]{0,200}"
_LIST: Final = r"\[[\n !\"$-Z^-z]*\]"
_GROUP: Final = r"\{[ !\"$-z]*\}"
_LINE: Final = pattern(
    rf"( *)(?:({_KEY}):(?: +({_SCALAR}|{_LIST}|{_GROUP}))?|- +({_SCALAR}))? *(?:(?<![^ \n])#[ -~]*)?(?:\n|\Z)"
)
_ITEM: Final = pattern(rf"[ \n]*({_SCALAR})[ \n]*([,\]])")
_PAIR: Final = pattern(rf" *({_KEY}): +({_SCALAR}) *([,}}])")
_DEEPEST: Final = 20
_NAMESPACES: Final = 3  # names that nodes stand below


def sections_of(text: str, file: str) -> tuple[Section, ...] | None:
    """Return the sections of a file of which there is nothing to tell; None where that is not plain to see."""
    if not text.isascii():
        return None
    lines: list[tuple[int, re.Match[str]]] = []
    at = number = 0
    while at < len(text):
        found = _LINE.match(text, at)
        if found is None:
            return None
        at, number = found.end(), number + 1
        if found[2] is not None or found[4] is not None:
            lines.append((number, found))
            if found[3] is not None and found[3][0] == "[":
                number += found[3].count("\n")
    if not lines:
        return None
    reader = _Lines(file, lines, number + 1 if text.endswith("\n") else None)
    try:
        reader.nodes(0, ())
    except (Unlike, IndexError):  # the end where something has to follow
        return None
    if reader.is_widened and _overrules(reader.found):
        return None
    return tuple(reader.found) if reader.next == len(lines) else None


def _overrules(sections: Sequence[Section]) -> bool:
    """Return whether a section sets what one before it has set for a node."""
    from orchestra.resolve.rcl.widened import widened  # noqa: PLC0415 - few files have such sections

    return any(widened(sections))


class _Lines:
    """Goes through the lines that have keys or dashes: their numbers, and what was matched of each.

    The text ends at the begin of a line `end`, None where its last line is open.
    """

    __slots__ = (
        *(
            "_bare",
            "_dotted",
            "_end_line",
            "_entries",
            "_file",
            "_grouped",
            "_lines",
            "_patterns",
            "_plugged",
        ),
        *("_taken", "found", "is_widened", "next"),
    )

    def __init__(self, file: str, lines: list[tuple[int, re.Match[str]]], end: int | None) -> None:
        self._file = file
        self._lines = lines
        self._end_line = end
        self._patterns: set[str] = set()
        self._bare: set[str] = set()
        self.next = 0
        self.found: list[Section] = []
        self.is_widened = False

    def nodes(self, column: int, names: tuple[str, ...]) -> None:
        """Take the mapping from the next line on whose keys begin in a column, below the names of namespaces."""
        lines, count = self._lines, len(self._lines)
        if len(lines[self.next][1][1]) != column:
            raise Unlike
        while self.next < count and len(lines[self.next][1][1]) == column:
            number, line = lines[self.next]
            name = line[2]
            if name is None:
                raise Unlike
            if line[3] is not None or name.startswith(SECTION_KEY) or name.endswith("/"):
                raise Unlike
            if names and ("/" in name or len(names) == _NAMESPACES or is_misspelt_section(name)):
                raise Unlike
            self.next += 1
            below = self._deeper(column)
            if lines[self.next][1][2] == SECTION_KEY:
                self._section("/".join((*names, name)), self._place(number, line, 2), below)
            else:
                self.nodes(below, (*names, name))
        self._end(column)

    def _section(self, name: str, at: Location, column: int) -> None:
        if (
            name in self._patterns
            or pattern_fault(name) is not None
            or self._lines[self.next][1][3] is not None
        ):
            raise Unlike
        bare = name.removeprefix("/")
        self.is_widened = self.is_widened or bare in self._bare or ("*" in name and bool(self._patterns))
        self._patterns.add(name)
        self._bare.add(bare)
        self._entries: list[Entry] = []
        self._taken: set[str] = set()
        self._dotted = self._grouped = self._plugged = False
        self.next += 1
        self._parameters(self._deeper(column), "", 0)
        self._end(column - 1)
        if self._dotted and self._grouped:  # rcl takes names apart at their points
            raise Unlike
        section = Section(name, tuple(self._entries), at)
        if self._plugged or name.endswith("_costmap"):
            from orchestra.resolve.rcl.listed import is_shallow, unlisted  # noqa: PLC0415 - only Nav2 has such

            if any(unlisted(section)) or is_shallow(section):
                raise Unlike
        self.found.append(section)

    def _parameters(self, column: int, group: str, depth: int) -> None:
        lines, count = self._lines, len(self._lines)
        if depth > _DEEPEST:
            raise Unlike
        while self.next < count and len(lines[self.next][1][1]) == column:
            number, line = lines[self.next]
            written = line[3]
            if line[2] is None:
                raise Unlike
            self.next += 1
            key = self._place(number, line, 2)
            if written is None and lines[self.next][1][4] is not None:
                self._items(line, column, key, group)
            elif written is None:
                below = self._deeper(column)
                first = lines[self.next][0]
                opened = new_location(new_span(self._file, first, below + 1, first, below + 2), ())
                name = self._put(line[2], None, opened, key, group)
                self._parameters(below, name, depth + 1)
            elif written[0] == "[":
                self._list(number, line, key, group)
            elif written[0] == "{":
                self._group(number, line, key, group)
            else:
                value = named_value(written, f"{group}.{line[2]}" if group else line[2])
                self._put(line[2], value, self._place(number, line, 3), key, group)
        self._end(column)

    def _put(
        self,
        name: str,
        value: ParameterValue | None,
        at: Location,
        key: Location,
        group: str,
        items: tuple[Location, ...] = (),
    ) -> str:
        """Add a parameter, or a group of them, which has no value; return its whole name."""
        whole = f"{group}.{name}" if group else name
        if whole in self._taken or "/" in name or "*" in name or name.startswith(SECTION_KEY):
            raise Unlike
        self._taken.add(whole)
        self._dotted = self._dotted or "." in name
        self._grouped = self._grouped or value is None
        self._plugged = self._plugged or name == "plugin"
        self._entries.append(new_entry(whole, value, at, key, group or whole, value is None, items))
        return whole

    def _items(self, line: re.Match[str], column: int, key: Location, group: str) -> None:
        """Take the lines with dashes below a key that begins in a column."""
        lines, count = self._lines, len(self._lines)
        number, first = lines[self.next]
        below = len(first[1])
        if below < column:
            raise Unlike
        values, items = [], []
        while (
            self.next < count and len(lines[self.next][1][1]) == below and lines[self.next][1][4] is not None
        ):
            place, found = lines[self.next]
            values.append(value_of(found[4]))
            items.append(self._place(place, found, 4))
            self.next += 1
        # To libyaml a list ends where the next thing begins.
        behind, at = (
            (self._end_line, 0) if self.next == count else (lines[self.next][0], len(lines[self.next][1][1]))
        )
        if behind is None:
            raise Unlike
        span = new_span(self._file, number, below + 1, behind, at + 1)
        self._put_list(line[2], values, new_location(span, ()), key, group, items)

    def _list(self, number: int, line: re.Match[str], key: Location, group: str) -> None:
        (begin, end), text = line.span(3), line.string
        values, items = [], []
        at, following = begin + 1, ","
        while following == ",":
            found = _ITEM.match(text, at, end)
            if found is None:
                raise Unlike
            values.append(value_of(found[1]))
            items.append(self._spot(number, line, *found.span(1)))
            at, following = found.end(), found[2]
        if at != end:
            raise Unlike
        self._put_list(line[2], values, self._spot(number, line, begin, end), key, group, items)

    def _spot(self, number: int, line: re.Match[str], first: int, last: int) -> Location:
        """Return the place between two offsets behind the key of a line, which may go on over several."""
        text, begin = line.string, line.start()
        lines = text.count("\n", begin, first)
        more = text.count("\n", first, last)
        start = begin if not lines else text.rindex("\n", begin, first) + 1
        stop = start if not more else text.rindex("\n", first, last) + 1
        span = new_span(self._file, number + lines, first - start + 1, number + lines + more, last - stop + 1)
        return new_location(span, ())

    def _put_list(
        self, name: str, values: list[Scalar], at: Location, key: Location, group: str, items: list[Location]
    ) -> None:
        one = len(values) == 1 and isinstance(values[0], str) and " " in values[0]  # commas may be missing
        if one or len(set(map(type, values))) != 1:
            raise Unlike
        self._put(name, tuple(values), at, key, group, tuple(items))  # type: ignore[arg-type] # of one type

    def _group(self, number: int, line: re.Match[str], key: Location, group: str) -> None:
        begin, end = line.span(3)
        head = begin - line.start() + 1
        opened = new_location(new_span(self._file, number, head, number, head + 1), ())
        name = self._put(line[2], None, opened, key, group)
        at, following = begin + 1, ","
        while following == ",":
            found = _PAIR.match(line.string, at, end)
            if found is None:
                raise Unlike
            value, first = named_value(found[2], f"{name}.{found[1]}"), line.start()
            self._put(
                found[1],
                value,
                self._place(number, found, 2, first),
                self._place(number, found, 1, first),
                name,
            )
            at, following = found.end(), found[3]
        if at != end:
            raise Unlike

    def _deeper(self, column: int) -> int:
        """Return the column of the mapping below a key."""
        below = len(self._lines[self.next][1][1])
        if below <= column:
            raise Unlike
        return below

    def _end(self, column: int) -> None:
        """Refuse a line that goes on deeper than in a column, where a mapping has ended."""
        if self.next < len(self._lines) and len(self._lines[self.next][1][1]) > column:
            raise Unlike

    def _place(self, number: int, found: re.Match[str], group: int, begin: int | None = None) -> Location:
        """Return the place of a group in a line, which begins where the match does if nothing else is said."""
        first, last = found.span(group)
        begin = found.start() - 1 if begin is None else begin - 1
        return new_location(new_span(self._file, number, first - begin, number, last - begin), ())
