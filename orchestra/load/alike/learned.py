"""How actions of one form are written, and what is made of their values.

Launch files that are long say the same few things time and again. An action that has been read in the ordinary way
becomes a regular expression, in which its values are groups, and a function that makes the same objects of other
values. Of each form several are read first: it takes as long to learn as some five actions take to be read.

Nothing is read here that the ordinary way would read otherwise: values are of characters that mean nothing in the
format, and whatever there is to tell of one sends the whole file the ordinary way.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any, Final

from orchestra.dataclass import dataclass
from orchestra.description.entity import Action
from orchestra.fields import field
from orchestra.load.offsets import Source
from orchestra.load.reader import Reader

# So many of one form are read before it is learned, and more of short ones, by the square of how many words they have:
# they save little, and take a third as long to be learned as long ones, which is as long as these save with some 50
# actions. One that takes the ordinary way, for it is not plain to see what it says, counts for 8. So many forms are
# kept of each beginning and in all. What looks alike may be of several forms, as with quotes and without: after four
# times as many the next one is learned.
FEW: Final = 12
SHORT: Final = 2_000
LONG: Final = 8
_LATER: Final = 4
UNKNOWN: Final = 0
_MOST_ALIKE: Final = 8
_MOST: Final = 100
# So many forms that have been seen too seldom are counted.
_MOST_COUNTED: Final = 2_000


class UnlikeError(Exception):
    """A value is not one of those that can be told by their characters alone."""


@dataclass(slots=True)
class Item:
    """A stretch of a file that holds one action, and how it begins: actions of one form begin alike.

    Where its end is `UNKNOWN`, whoever reads it finds it.
    """

    begin: int
    end: int
    beginning: str


@dataclass(frozen=True, slots=True)
class Manner:
    """How a format writes values and ends actions.

    `harmless` gives an expression for all texts that may stand in the place of one without a change of anything around
    them, empty where there is none: the text of the file, and the offsets of the action, of the value and behind it.
    `ending` does so for what is behind the last value, with the text that has to stand there first.
    """

    harmless: Callable[[str, int, int, int], str]
    ending: Callable[[str], tuple[str, str]]


@dataclass(frozen=True, slots=True)
class Form:
    """One way to write an action: what matches its text, and what makes the action of a match."""

    pattern: re.Pattern[str]
    make: Callable[[Source, re.Match[str], Reader], Action]


@dataclass(slots=True)
class Forms:
    """The forms of one format that are known, by how the text of an action begins."""

    few: int = FEW
    short: int = SHORT
    known: dict[str, list[Form]] = field(default_factory=dict)
    _counted: dict[tuple[Any, ...], tuple[int, int]] = field(default_factory=dict)

    def worth(self, words: tuple[Any, ...], weight: int) -> bool:
        """Count an action of a form that is not known; tell whether it is time to learn it."""
        if len(self._counted) >= _MOST_COUNTED:
            self._counted.clear()
        count, enough = self._counted.get(words) or (0, self.few + self.short // _length(words) ** 2)
        count += weight
        due = count >= enough
        self._counted[words] = (count, enough * _LATER if due else enough)
        return due and sum(map(len, self.known.values())) < _MOST

    def keep(self, beginning: str, form: Form) -> None:
        """Keep a form; of those that begin alike the last one is tried first."""
        alike = self.known.setdefault(beginning, [])
        alike.insert(0, form)
        del alike[_MOST_ALIKE:]


def _length(words: tuple[Any, ...]) -> int:
    """Return of how many words an action is, those of each of its tags counted."""
    return sum(1 if isinstance(word, str) else len(word) for word in words)


def action_of(forms: list[Form] | None, whole: Source, item: Item, reader: Reader) -> Action | None:
    """Return the action of a stretch, where it is of one of these forms."""
    begin, end = item.begin, item.end
    for form in forms or ():
        pattern = form.pattern
        match = pattern.fullmatch(whole.text, begin, end) if end else pattern.match(whole.text, begin)
        if match is not None:
            item.end = match.end()
            return form.make(whole, match, reader)
    return None
