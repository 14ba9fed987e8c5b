"""Python files that are alike but for texts, numbers and numbered names: the code of one is made from that of another.

Trees that were generated have dozens of such files, and to compile one takes as long as all else that is done to load
it. Two of them are compiled; where they differ there is a form (`form`): what the compiler made of the one and of the
other shows where literals go that decide nothing but a constant (`form_slots`). From then on the form is as good as
the compiler where

- the rest of the text is the same, and what differs is written as plainly;
- literals are equal to one another just where they are in the form: equal constants are one constant;
- none is equal to a constant that the form has besides (from 3.12 on those of code that is never reached are not there
  to be seen: a text that is equal to one that was joined there is numbered in another way than by the compiler, and
  the code does the same);
- of names only those of a function's own variables that end with a number are others (`node_12`), under the same terms.

What it makes of the second file has to be what the compiler made of it, down to the table of positions. A file that
differs elsewhere too is compiled, and makes the form wider. Wherever there is a doubt there is the compiler, and for
whatever does more than to import, define functions, assign, call and return. Rejected: other names too: the compiler
sorts some, and some become constants; a form of one file, by a text with marks in place of all literals: it has to be
compiled as well, and most literals of alike files are the same.
"""

from __future__ import annotations

import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Final

from orchestra.patterns import pattern
from orchestra.resolve.python.form import Form
from orchestra.resolve.python.form_codes import variables
from orchestra.resolve.python.form_slots import Slots, split
from orchestra.resolve.python.numbered import asked_of

if TYPE_CHECKING:
    from orchestra.compat.looks import Compiled

_KNOWN: Final = ((3, 11), (3, 12), (3, 13))  # versions whose compilers make such codes
_ODD: Final = (b"\0", b"\r", b"\f", b"\v")
# One of the first two lines says that a text is written in another way than by the signs that stand in it.
_CODED: Final = pattern(rb"(?:[^\n]*\n)?[ \t]*#[^\n]*coding[:=](?![ \t]*(?i:utf[-_]?8))")
_FEW: Final = 8  # parts of a text that a form is worth, and files of one length that are not alike
_MOST: Final = 64  # lengths of files
_PATIENCE: Final = 6  # files of one length that are compiled before no more forms are looked for among them
_TRIES: Final = 6  # files that a form is learned with


class Forms:
    """The forms of files, and those files that are alone of their form so far, by the number of their lines."""

    def __init__(self) -> None:
        self._known: dict[int, list[First]] = {}
        self._missed: dict[int, int] = {}

    def compiled(self, path: str, source: bytes) -> Compiled | None:
        """Return the code of a file, None where no form is known."""
        known = self._known.get(lines := source.count(b"\n"))
        text = None if known is None else _plain(source)
        if known is None or text is None:
            return None
        for other in [other for first in known for other in first.to_learn()]:
            if not any(first.learns(other) for first in reversed(known)):
                _add(known, other)
        for first in known:
            made = None if first.form is None else first.form.compiled(path, source, text)
            if made is not None:
                self._missed[lines] = 0
                return made
        return None

    def add(self, compiled: Compiled) -> None:
        """Learn from a file that was compiled, of which the compiler had nothing to tell.

        Nothing is done with it before a third one comes that may be alike.
        """
        lines = compiled.source.count(b"\n")
        missed = self._missed[lines] = self._missed.get(lines, 0) + 1
        text = _plain(compiled.source) if missed <= _PATIENCE else None
        if text is None:
            return
        known = self._known.get(lines)
        if known is None:
            if len(self._known) >= _MOST:
                del self._known[next(iter(self._known))]
            known = self._known[lines] = []
        other = First(text, compiled)
        if not any(first.takes(other) for first in reversed(known)):
            _add(known, other)


def _add(known: list[First], first: First) -> None:
    if len(known) < _FEW:
        known.append(first)


def _plain(source: bytes) -> str | None:
    """Return a text in which a column is a byte; None for another one."""
    if sys.version_info[:2] not in _KNOWN or not source.isascii() or any(odd in source for odd in _ODD):
        return None
    if _CODED.match(source):
        return None
    return source.decode("ascii")


class First:
    """A file that was compiled, of which a form is learned with other ones."""

    def __init__(self, text: str, compiled: Compiled) -> None:
        self.form: Form | None = None
        self._text = text
        self._compiled = compiled
        self._asked = asked_of(compiled.code)
        self._to_learn: list[First] = []
        self._parts: list[str] = []
        self._slots: Slots | None = None
        self._others = set[int]()
        self._is_known = False
        self._tries = _TRIES

    def takes(self, other: First) -> bool:
        """Return whether another file may be of one form with this one, as it is then learned with the third one."""
        if self._tries == 0 or other._asked != self._asked:
            return False
        self._to_learn.append(other)
        return True

    def to_learn(self) -> list[First]:
        """Return those that were taken since the last time."""
        others, self._to_learn = self._to_learn, []
        return others

    @property
    def parts(self) -> list[str]:
        """The text between literals, and those."""
        self._parts = self._parts or split(self._text)
        return self._parts

    def learns(self, other: First) -> bool:
        """Return whether there is a form of this file and another one, or cannot be one with any."""
        if self._tries == 0 or other._asked != self._asked or other.parts[::2] != self.parts[::2]:
            return False
        self._tries -= 1
        if not self._is_known:
            self._is_known = True
            with suppress(Exception):  # as below
                if len(self.parts) > _FEW:
                    self._slots = Slots(self.parts, variables(self._compiled.code))
        if self._slots is None:
            return True
        own, literals = self.parts[1::2], other.parts[1::2]
        others = self._others.union(index for index, text in enumerate(literals) if text != own[index])
        with suppress(Exception):  # whatever stands against it
            places, taken = self._slots.at(sorted(others))
            self.form = Form((self.parts, self._compiled), (other.parts, other._compiled), places, taken)
            self._others = others
            return True
        return False


FORMS: Final = Forms()
