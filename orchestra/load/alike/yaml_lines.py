"""Actions in YAML that stand line by line, as nearly all do: a key and what is behind it, or an item of a list.

One expression tells a line, and the column at which it begins what it belongs to. Values are texts that mean the same
to every reader of YAML, and lists and mappings of such on one line. Anything else takes a parser.
"""

from __future__ import annotations

import re
from operator import attrgetter
from typing import TYPE_CHECKING, Any, Final

from orchestra.description.source import Written
from orchestra.load.alike.learned import UnlikeError
from orchestra.load.alike.straight import Keys, Plainly, Series
from orchestra.load.offsets import spans_of
from orchestra.location import Places, stretch

if TYPE_CHECKING:
    from orchestra.load.alike.straight import Scalar
    from orchestra.load.offsets import Source

_DEEPEST: Final = 20

_COMMENT: Final = r"#[\t -~\xa0-\xff]*"
_KEY: Final = r"[A-Za-z_][A-Za-z0-9_-]*"
# What a value begins with that means nothing to YAML, and what may follow, outside of brackets and inside. Nothing that
# has been matched is given back: there is one way to read a line.
_BEGUN: Final = r"A-Za-z0-9_/.$()+<=~^;\\"
_BLOCK: Final = r"(?:[!-9;-~]++|:(?=[!-~]))"
_PLAIN: Final = (
    rf"(?!(?:~|[nN]ull|NULL)(?:[ \n]|\Z))(?:[{_BEGUN}]|-(?=[!-~])){_BLOCK}*+(?: ++(?!\#){_BLOCK}++)*+"
)
_FLOW: Final = r"""[!"$-+\--9;->@-Z\\^-z|~]"""
_IN_FLOW: Final = rf"(?!(?:~|[nN]ull|NULL)[ ,\]}}])(?:[{_BEGUN}]|-(?=[{_BEGUN}-])){_FLOW}*+(?: ++{_FLOW}++)*+"
# With the escapes of quotes and of what escapes, as expressions have them.
_DOUBLE: Final = r'''"((?:[ !#-\[\]-~]++|\\["\\])*+)"'''
_SINGLE: Final = r"'((?:[ -&(-~]++|'')*+)'"
_REST: Final = rf" *+(?:(?<![^ \n]){_COMMENT})?+(?:\n|\Z)"
_VALUE: Final = rf"{_DOUBLE}|{_SINGLE}"
_LINE: Final = re.compile(
    rf"( *+)(- ++)?+(?:({_KEY}):(?=[ \n]|\Z) *+)?+(?:{_VALUE}|({_PLAIN})|([\[{{])[^\n]*+)?+{_REST}|([^\n]*+\n?)"
)
_BEHIND: Final = re.compile(_REST)
_ITEM: Final = re.compile(rf" *+(?:{_VALUE}|({_IN_FLOW})|([\[{{]))")
_PAIR: Final = re.compile(rf" *+({_KEY}): ++(?:([\[{{])|(?:{_VALUE}|({_IN_FLOW})) *+([,\]}}]))")
_ESCAPED: Final = re.compile(r'\\(["\\])')
_NEXT: Final = re.compile(r" *+([,\]}])")
# The groups of a line.
_last_group: Final = attrgetter("lastindex")
_INDENT, _DASH, _NAME, _IN_DOUBLE, _IN_SINGLE, _BARE, _OPEN, _ODD = range(1, 9)
# Those of an item and of a pair in brackets.
_PLAIN_IN_ITEM, _OPEN_IN_ITEM, _PLAIN_IN_PAIR = 3, 4, 5


def scanned(whole: Source, begin: int, end: int) -> Plainly | None:
    """Return the action that is the one item of a list between two offsets; None where it takes a parser."""
    lines = [line for line in _LINE.finditer(whole.text, begin, end) if line.lastindex != _INDENT]
    if _ODD in map(_last_group, lines):
        return None
    scan = _Scan(whole, lines, end)
    try:
        items = scan.series(lines[0].end(_INDENT) - begin, 0, 0)
    except (UnlikeError, IndexError):  # the end where something has to follow
        return None
    if scan.line != len(lines) or len(items.items) != 1 or type(items.items[0]) is not Keys:
        return None
    return Plainly(items.items[0], scan.places, tuple(scan.words))


class _Scan:
    """Goes through lines; `line` is the number of the next one. `words` are the keys, and what else shows the form."""

    __slots__ = ("end", "line", "lines", "places", "text", "whole", "words")

    def __init__(self, whole: Source, lines: list[re.Match[str]], end: int) -> None:
        self.whole = whole
        self.text = whole.text
        self.lines = lines
        self.line = 0
        self.end = end
        self.places = Places(whole)
        self.words: list[str] = []

    def keys(self, column: int, head: int | None, depth: int) -> Keys:
        """Return the mapping whose keys begin in a column, from the next line on, behind the dash that may be there."""
        values: dict[str, Any] = {}
        lines, count, number, places = self.lines, len(self.lines), self.line, self.places.offsets
        line = lines[number]
        _, _, key, double, single, plain, opening, _ = line.groups()
        if head is None:
            head = len(places)
            places.append(line.span(_NAME))
        words = self.words
        while True:
            if key is None or key in values:
                raise UnlikeError
            words.append(key)
            number += 1
            if plain is not None:
                values[key] = (plain, len(places), False)
                places.append(line.span(_BARE))
            elif double is not None or single is not None:
                values[key] = self.quoted(line, _IN_DOUBLE if single is None else _IN_SINGLE)
            else:
                self.line = number
                values[key] = self.inner(line, opening is not None, column, depth)
                number = self.line
            if number == count:
                break
            line = lines[number]
            indent, dash, key, double, single, plain, opening, _ = line.groups()
            if dash is None and len(indent) == column:
                continue
            if len(indent) >= column:
                raise UnlikeError
            break
        self.line = number
        return Keys(values, head)

    def inner(self, line: re.Match[str], opened: bool, column: int, depth: int) -> Keys | Series:
        """Return what stands behind a key in brackets, or on the lines below it."""
        head = self.places.add(line.span(_NAME))
        return self.opened(line, head) if opened else self.below(head, column, depth)

    def below(self, head: int, column: int, depth: int) -> Keys | Series:
        """Return what stands below a key that has nothing behind it."""
        following = self.lines[self.line]
        indent = len(following[_INDENT])
        if following[_DASH] is not None:
            if indent < column:
                raise UnlikeError
            return self.series(indent, head, depth + 1)
        if indent <= column or depth > _DEEPEST:
            raise UnlikeError
        return self.keys(indent, head, depth + 1)

    def series(self, column: int, head: int, depth: int) -> Series:
        """Return the list whose dashes stand in a column, from the next line on."""
        items: list[Any] = []
        lines, count = self.lines, len(self.lines)
        begin = lines[self.line].start(_DASH)
        while self.line < count:
            line = lines[self.line]
            indent = len(line[_INDENT])
            if line[_DASH] is None or indent < column:
                break
            last = line.lastindex
            if indent > column or last == _DASH or depth > _DEEPEST:
                raise UnlikeError
            self.words.append("-")
            if line[_NAME] is not None:
                items.append(self.keys(line.start(_NAME) - line.start(), None, depth + 1))
                continue
            self.line += 1
            items.append(self.opened(line, None) if last == _OPEN else self.scalar(line, last == _BARE))
        # It ends where the next thing begins.
        end = self.end if self.line == count else lines[self.line].end(_INDENT)
        return Series(items, self.places.add((begin, end)), head)

    def scalar(self, found: re.Match[str], plain: bool) -> Scalar | Written:
        """Return the text of the last group."""
        group: Any = found.lastindex
        return (
            (found[group], self.places.add(found.span(group)), False) if plain else self.quoted(found, group)
        )

    def quoted(self, found: re.Match[str], group: int) -> Scalar | Written:
        """Return the text of a group, which stands in quotes."""
        text, (begin, end) = found[group], found.span(group)
        style = self.text[end]
        if ("\\" if style == '"' else "'") not in text:
            return text, self.places.add((begin, end)), True
        begin, end = begin - 1, end + 1
        value = _ESCAPED.sub(r"\1", text) if style == '"' else text.replace("''", "'")
        return Written(
            value, stretch(self.whole, begin, end), spans_of(self.whole, begin, end, value, style), True
        )

    def opened(self, line: re.Match[str], head: int | None) -> Keys | Series:
        """Return what stands in brackets behind a key, or behind a dash, up to the end of the line."""
        value, at = self.flow(line.start(_OPEN), line[_OPEN], head, 0)
        behind = _BEHIND.match(self.text, at, line.end())
        if behind is None or behind.end() != line.end():
            raise UnlikeError
        return value

    def flow(self, begin: int, opening: str, head: int | None, depth: int) -> tuple[Keys | Series, int]:
        """Return what stands in brackets that open at an offset, and the offset behind it."""
        if depth > _DEEPEST:
            raise UnlikeError
        self.words.append(opening)
        if head is None:
            head = self.places.add((begin, begin + 1))
        if opening == "{":
            values, at = self.pairs(begin + 1, depth)
            return Keys(values, head), at
        items, at = self.items(begin + 1, depth)
        return Series(items, self.places.add((begin, at)), head), at

    def pairs(self, at: int, depth: int) -> tuple[dict[str, Any], int]:
        """Return what stands in braces, and the offset behind it."""
        values: dict[str, Any] = {}
        text, end, places, words = self.text, self.end, self.places.offsets, self.words
        while True:
            found = _PAIR.match(text, at, end)
            if found is None:
                raise UnlikeError
            key, opening, _, single, plain, following = found.groups()
            if key in values:
                raise UnlikeError
            words.append(key)
            at = found.end()
            if plain is not None:
                values[key] = (plain, len(places), False)
                places.append(found.span(_PLAIN_IN_PAIR))
            elif opening is None:
                values[key] = self.quoted(found, _PLAIN_IN_PAIR - (2 if single is None else 1))
            else:
                places.append(found.span(1))
                values[key], at = self.flow(at - 1, opening, len(places) - 1, depth + 1)
                following, at = self.following(at)
            if following != ",":
                break
        if following != "}":
            raise UnlikeError
        return values, at

    def following(self, at: int) -> tuple[str, int]:
        """Return what separates or closes at an offset or behind blanks, and the offset behind that."""
        found = _NEXT.match(self.text, at, self.end)
        if found is None:
            raise UnlikeError
        return found[1], found.end()

    def items(self, at: int, depth: int) -> tuple[list[Any], int]:
        """Return what stands in brackets, and the offset behind it."""
        items: list[Any] = []
        text, end = self.text, self.end
        while True:
            found = _ITEM.match(text, at, end)
            if found is None:
                raise UnlikeError
            at = found.end()
            if found.lastindex == _OPEN_IN_ITEM:
                value, at = self.flow(at - 1, found[_OPEN_IN_ITEM], None, depth + 1)
                items.append(value)
            else:
                items.append(self.scalar(found, found.lastindex == _PLAIN_IN_ITEM))
            following, at = self.following(at)
            if following != ",":
                break
        if following != "]":
            raise UnlikeError
        return items, at
