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
from orchestra.load.alike.straight import Keys, Series
from orchestra.load.offsets import spans_of
from orchestra.location import GROUPS, Places, stretch

if TYPE_CHECKING:
    from orchestra.load.alike.straight import Scalar
    from orchestra.load.offsets import Source

DEEPEST: Final = 20

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
# A text in which no call, nor anything else that means something, can stand; and such a one in quotes. A null ends so.
_WORD: Final = r"(-{0,2}+[A-Za-z0-9_./][A-Za-z0-9_./-]*+)(?<!ull)(?<!ULL)"
_IN_QUOTES: Final = r'"([ !#%&)-\[\]-~]++)"'
# Two texts in braces, up to the end of the line: as most parameters, remaps and arguments stand.
_TWO: Final = (
    rf"(?<=\{{) *+({_KEY}): ++(?:{_WORD}(?= *+,)|({_IN_FLOW})) *+, *+"
    rf"({_KEY}): ++(?:{_WORD}(?= *+\}})|{_IN_QUOTES}|({_IN_FLOW})) *+\}}(?= *+(?:\n|\#|\Z))"
)
# How nearly all lines end comes first.
_LINE: Final = re.compile(
    rf"( *+)(- ++)?+(?:({_KEY}):(?=[ \n]|\Z) *+)?+"
    rf"(?:{_WORD}\n|\n|(?:{_VALUE}|({_PLAIN})|([\[{{])(?:{_TWO}|[^\n]*+))?+(?:\n|{_REST}))|([^\n]*+\n?)"
)
_BEHIND: Final = re.compile(_REST)
_ITEM: Final = re.compile(rf" *+(?:([\[{{])|(?:{_VALUE}|({_IN_FLOW})) *+([,\]}}]))")
PAIR: Final = re.compile(rf" *+({_KEY}): ++(?:([\[{{])|(?:{_VALUE}|({_IN_FLOW})) *+([,\]}}]))")
# A list of words on one line, as nearly all write them.
_ITEM_IN_LIST: Final = r"-{0,2}+[A-Za-z0-9_./][A-Za-z0-9_./-]*+(?<!ull)(?<!ULL)"
_LISTED: Final = re.compile(rf"{_ITEM_IN_LIST}(?:, {_ITEM_IN_LIST})*+\]")
_ESCAPED: Final = re.compile(r'\\(["\\])')
_NEXT: Final = re.compile(r" *+([,\]}])")
# The groups of a line.
_last_group: Final = attrgetter("lastindex")
INDENT, DASH, NAME, WORD, IN_DOUBLE, IN_SINGLE, BARE, OPEN = range(1, 9)
FIRST_KEY, FIRST_WORD, FIRST, SECOND_KEY, SECOND_WORD, SECOND_QUOTED, SECOND, _ODD = range(9, 17)
_SAID: Final = NAME, WORD, IN_DOUBLE, IN_SINGLE, BARE, OPEN
PLAIN: Final = frozenset({WORD, BARE})
TWO: Final = frozenset({SECOND_WORD, SECOND_QUOTED, SECOND})
BRACKETS: Final = frozenset({OPEN, *TWO})
# Those of an item and of a pair in brackets.
_DOUBLE_IN_ITEM, _SINGLE_IN_ITEM, _PLAIN_IN_ITEM = 2, 3, 4
KEY_IN_PAIR, DOUBLE_IN_PAIR, SINGLE_IN_PAIR, PLAIN_IN_PAIR = 1, 3, 4, 5


def lines_of(whole: Source, begin: int, end: int) -> list[re.Match[str]] | None:
    """Return the lines between two offsets that say something; None where one takes a parser."""
    lines = [line for line in _LINE.finditer(whole.text, begin, end) if line.lastindex != INDENT]
    return None if _ODD in map(_last_group, lines) else lines


class Scan:
    """Goes through lines; `line` is the number of the next one. `words` are the keys, and what else shows the form."""

    __slots__ = ("count", "end", "line", "lines", "places", "text", "whole", "words")

    def __init__(self, whole: Source, lines: list[re.Match[str]], end: int) -> None:
        self.whole = whole
        self.text = whole.text
        self.lines = lines
        self.count = len(lines)
        self.line = 0
        self.end = end
        self.places = Places(whole, [*lines])
        self.words: list[str] = []

    def keys(self, column: int, head: int | None, depth: int) -> Keys:
        """Return the mapping whose keys begin in a column, from the next line on, behind the dash that may be there."""
        values: dict[str, Any] = {}
        lines, count, number = self.lines, self.count, self.line
        line = lines[number]
        key, word, double, single, plain, opening = line.group(*_SAID)
        if head is None:
            head = number << GROUPS | NAME
        words = self.words
        while True:
            if key is None or key in values:
                raise UnlikeError
            words.append(key)
            if word is not None or plain is not None:
                values[key] = (word or plain, number << GROUPS | (BARE if word is None else WORD), False)
                number += 1
            elif double is not None or single is not None:
                values[key] = self.quoted(line, number << GROUPS, IN_DOUBLE if single is None else IN_SINGLE)
                number += 1
            else:
                self.line = number + 1
                head_of = number << GROUPS | NAME
                if opening is not None:
                    values[key] = self.opened(line, head_of)
                else:
                    values[key] = self.below(head_of, column, depth)
                number = self.line
            if number == count:
                break
            line = lines[number]
            indent, dash, key, word, double, single, plain, opening = line.group(INDENT, DASH, *_SAID)
            if dash is None and len(indent) == column:
                continue
            if len(indent) >= column:
                raise UnlikeError
            break
        self.line = number
        return Keys(values, head)

    def below(self, head: int, column: int, depth: int) -> Keys | Series:
        """Return what stands below a key that has nothing behind it."""
        following = self.lines[self.line]
        indent = len(following[INDENT])
        if following[DASH] is not None:
            if indent < column:
                raise UnlikeError
            return self.series(indent, head, depth + 1)
        if indent <= column or depth > DEEPEST:
            raise UnlikeError
        return self.keys(indent, head, depth + 1)

    def dashed(self, column: int, depth: int) -> re.Match[str] | None:
        """Return the next line where it has a dash of the list in a column, None where that ends."""
        if self.line == self.count:
            return None
        line = self.lines[self.line]
        indent, dash = line.group(INDENT, DASH)
        if dash is None or len(indent) < column:
            return None
        if len(indent) > column or line.lastindex == DASH or depth > DEEPEST:
            raise UnlikeError
        self.words.append("-")
        return line

    def series(self, column: int, head: int, depth: int) -> Series:
        """Return the list whose dashes stand in a column, from the next line on."""
        items: list[Any] = []
        begin = self.lines[self.line].start(DASH)
        while (line := self.dashed(column, depth)) is not None:
            if line[NAME] is not None:
                items.append(self.keys(line.start(NAME) - line.start(), None, depth + 1))
                continue
            self.line += 1
            if line.lastindex in BRACKETS:
                items.append(self.opened(line, None))
            else:
                items.append(self.scalar(line, self.line - 1 << GROUPS, line.lastindex in PLAIN))
        # It ends where the next thing begins.
        end = self.end if self.line == self.count else self.lines[self.line].end(INDENT)
        return Series(items, self.places.add((begin, end)), head)

    def scalar(self, found: re.Match[str], at: int, plain: bool) -> Scalar | Written:
        """Return the text of the last group; the match has a number."""
        group: Any = found.lastindex
        return (found[group], at | group, False) if plain else self.quoted(found, at, group)

    def quoted(self, found: re.Match[str], at: int, group: int) -> Scalar | Written:
        """Return the text of a group, which stands in quotes; the match has a number."""
        text = found[group]
        if "\\" not in text and "'" not in text:
            return text, at | group, True
        begin, end = found.span(group)
        style = self.text[end]
        if ("\\" if style == '"' else "'") not in text:
            return text, at | group, True
        begin, end = begin - 1, end + 1
        value = _ESCAPED.sub(r"\1", text) if style == '"' else text.replace("''", "'")
        return Written(
            value, stretch(self.whole, begin, end), spans_of(self.whole, begin, end, value, style), True
        )

    def opened(self, line: re.Match[str], head: int | None) -> Keys | Series:
        """Return what stands in brackets behind a key, or behind a dash, up to the end of the line."""
        value, at = self.flow(line.start(OPEN), line[OPEN], head, 0)
        self.end_line(line, at)
        return value

    def end_line(self, line: re.Match[str], at: int) -> None:
        """Refuse a line that goes on behind an offset with more than a comment."""
        end = line.end()
        if at + 1 == end and self.text[at] == "\n":  # as nearly all
            return
        behind = _BEHIND.match(self.text, at, end)
        if behind is None or behind.end() != end:
            raise UnlikeError

    def flow(self, begin: int, opening: str, head: int | None, depth: int) -> tuple[Keys | Series, int]:
        """Return what stands in brackets that open at an offset, and the offset behind it."""
        if depth > DEEPEST:
            raise UnlikeError
        self.words.append(opening)
        if head is None:
            head = self.places.add((begin, begin + 1))
        if opening == "{":
            values, at = self.pairs(begin + 1, depth)
            return Keys(values, head), at
        listed = _LISTED.match(self.text, begin + 1, self.end)
        if listed is not None:
            return Series(
                self.bare(listed), self.places.add((begin, listed.end())), head, bare=True
            ), listed.end()
        items, at = self.items(begin + 1, depth)
        return Series(items, self.places.add((begin, at)), head), at

    def bare(self, listed: re.Match[str]) -> list[Any]:
        """Return the words of a list, up to its bracket."""
        items: list[Any] = []
        told, at = self.places.told, listed.start()
        for word in listed[0][:-1].split(", "):
            behind = at + len(word)
            told.append((at, behind))
            items.append((word, len(told) - 1 << GROUPS, False))
            at = behind + 2
        return items

    def pairs(self, at: int, depth: int) -> tuple[dict[str, Any], int]:
        """Return what stands in braces, and the offset behind it."""
        values: dict[str, Any] = {}
        text, end, places, words = self.text, self.end, self.places, self.words
        while True:
            found = PAIR.match(text, at, end)
            if found is None:
                raise UnlikeError
            key, opening, _, single, plain, following = found.groups()
            if key in values:
                raise UnlikeError
            words.append(key)
            at, number = found.end(), places.add(found)
            if plain is not None:
                values[key] = (plain, number | PLAIN_IN_PAIR, False)
            elif opening is None:
                values[key] = self.quoted(found, number, DOUBLE_IN_PAIR if single is None else SINGLE_IN_PAIR)
            else:
                values[key], at = self.flow(at - 1, opening, number | KEY_IN_PAIR, depth + 1)
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
        text, end, places = self.text, self.end, self.places
        while True:
            found = _ITEM.match(text, at, end)
            if found is None:
                raise UnlikeError
            opening, _, single, plain, following = found.groups()
            at = found.end()
            if plain is not None:
                items.append((plain, places.add(found) | _PLAIN_IN_ITEM, False))
            elif opening is None:
                group = _DOUBLE_IN_ITEM if single is None else _SINGLE_IN_ITEM
                items.append(self.quoted(found, places.add(found), group))
            else:
                value, at = self.flow(at - 1, opening, None, depth + 1)
                items.append(value)
                following, at = self.following(at)
            if following != ",":
                break
        if following != "]":
            raise UnlikeError
        return items, at
