"""Python files that are alike but for texts, numbers and numbered names: the code of one is made from that of another.

Trees that were generated have dozens of such files, and to compile one takes as long as all else that is done to load
it. The first few of them are compiled. Then a form is learned: the text in which each literal that decides nothing but
a constant (`form_slots`) is a mark found nowhere else is compiled, which shows where the compiler puts each. From then
on the form is as good as the compiler where

- the text between literals is the same, and so are the literals that may decide anything else;
- literals are equal to one another just where they are in the form: equal constants are one constant;
- none is equal to a constant that the form has besides;
- of names only those of a function's own variables that end with a number are others (`node_12`), under the same terms.

What it makes of the first file has to be what the compiler made of it, down to the table of positions. Wherever there
is a doubt there is the compiler, and for whatever does more than to import, define functions, assign, call and return.
Rejected: other names too: the compiler sorts some, and some become constants.
"""

from __future__ import annotations

import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.looks import LOOKS
from orchestra.resolve.python.form_codes import (
    MARK,
    CodeForm,
    Columns,
    Marks,
    is_same,
    may_be_marked,
    variables,
)
from orchestra.resolve.python.form_slots import Name, classes, is_plain, slots, split

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Sequence
    from types import CodeType

_KNOWN: Final = ((3, 11), (3, 12), (3, 13))  # versions whose compilers make such codes
_ODD: Final = (b"\0", b"\r", b"\f", b"\v")
_NOT_PLAIN: Final = (b"\\", b'"""', b"'''")  # signs of texts that a quote does not end
_FEW: Final = 8  # literals that a form is worth, and forms of one text between literals
_SIGHTS: Final = (
    3  # more files that are alike but for literals and are compiled first: to learn takes as long
)
_MOST: Final = 64
_ASKING_NO_TEXT: Final = (
    "harmless",
    "tuples",
)  # looks at names and instructions alone, and at kinds of constants
_PATIENCE: Final = 6  # files of one length that are compiled before no more forms are looked for among them


class Forms:
    """The forms of files, and those files that are alone of their form so far."""

    def __init__(self) -> None:
        self._known: dict[tuple[str, ...], list[Form | First]] = {}
        self._missed: dict[int, int] = {}

    def code(
        self, path: str, source: bytes, compiled: Callable[[], tuple[CodeType, bool]], told: dict[str, bool]
    ) -> tuple[CodeType, bool]:
        """Return the code of a file, and whether to compile it again would tell nobody anything.

        `compiled` returns both from the compiler, which is asked where no form is known. Raises what it does. What
        looks tell of all files of a form is added to what is `told`.
        """
        lines = source.count(b"\n")
        parts = _parts(source) if self._missed.get(lines, 0) < _PATIENCE else None
        if parts is None:
            return compiled()
        known = self._kept(parts)
        made = _made(known, path, source, parts, told)
        if made is not None:
            self._missed.pop(lines, None)
            return made, True
        self._missed[lines] = self._missed.get(lines, 0) + 1
        code, lasting = compiled()
        if lasting and len(known) < _FEW:
            known.append(First(parts, code))
        return code, lasting

    def add(self, source: bytes, code: CodeType) -> None:
        """Take note of a file that was compiled, of which the compiler had nothing to tell."""
        parts = _parts(source)
        if parts is not None:
            self._kept(parts).append(First(parts, code))

    def _kept(self, parts: list[str]) -> list[Form | First]:
        """Return what is known of files whose text between literals is the same."""
        key = tuple(parts[::2])
        known = self._known.get(key)
        if known is None:
            if len(self._known) >= _MOST:
                del self._known[next(iter(self._known))]
            known = self._known[key] = []
        return known


def _made(
    known: list[Form | First], path: str, source: bytes, parts: list[str], told: dict[str, bool]
) -> CodeType | None:
    """Return the code of a file by one of the forms of its text, which may be learned now; None where none fits."""
    literals = parts[1::2]
    are_plain = not any(sign in source for sign in _NOT_PLAIN)
    for index, form in enumerate(known):
        learned = form.learned(literals) if isinstance(form, First) else form
        if learned is not None:
            known[index] = learned
            made = learned.code(path, literals, are_plain=are_plain)
            if made is not None:
                told.update(learned.told)
                return made
    return None


def _parts(source: bytes) -> list[str] | None:
    """Return the parts of a text in which a column is a byte; None for another one, or where literals are few."""
    if sys.version_info[:2] not in _KNOWN or not source.isascii() or any(odd in source for odd in _ODD):
        return None
    parts = split(source.decode("ascii"))
    return parts if len(parts) > _FEW else None


def _is_free(text: str) -> bool:
    """Return whether a text is a comment that says nothing of how the file is written."""
    return text.startswith("#") and "coding" not in text


class First:
    """A file that was compiled, of which a form is learned when enough other ones fit it."""

    def __init__(self, parts: list[str], code: CodeType) -> None:
        self._parts = parts
        self._code = code
        self._literals = parts[1::2]
        self._places: dict[int, str] | None = None
        self._words: set[str] = set()
        self._fixed: list[int] = []
        self._wait = _SIGHTS

    def learned(self, literals: list[str]) -> Form | None:
        """Return the form of the file, None where it has none yet, or where other literals would not fit it."""
        if self._wait != 0:
            self._wait -= 1
            return None
        if self._places is None:
            if not is_plain(self._parts):
                self._wait = -1
                return None
            self._places, self._words = slots(self._parts, variables(self._code))
            self._fixed = _others(self._literals, self._places)
        if any(self._literals[index] != literals[index] for index in self._fixed):
            return None
        self._wait = -1  # once is enough
        with suppress(Exception):  # whatever stands against it
            form = Form(self._parts, self._places, self._words, self._code)
            made = form.code(self._code.co_filename, self._literals)
            if made is not None and is_same(made, self._code):
                return form
        return None


def _others(literals: Sequence[str], places: Collection[int]) -> list[int]:
    """Return the numbers of the literals that have to be the same: neither those at places nor comments."""
    return [index for index, text in enumerate(literals) if index not in places and not _is_free(text)]


class Form:
    """What the codes of files have in common."""

    def __init__(self, parts: list[str], places: dict[int, str], words: set[str], code: CodeType) -> None:
        """Learn the form of a text that was split, with its code.

        `places` are the numbers of literals and ends of names that may be others, with what stands before these;
        `words` are all other names. Raises `ValueError` where there is no form.
        """
        literals = parts[1::2]
        texts = [before + literals[index] for index, before in places.items()]
        found = classes(texts, are_plain=False)
        if found is None or len(places) < _FEW or may_be_marked("".join(parts)):
            raise ValueError("nothing to learn")
        self._places = list(places)
        self._names = [(number, before) for number, before in enumerate(places.values()) if before]
        self._fixed = _others(literals, places)
        self._same = [literals[index] for index in self._fixed]
        self._comments = [index for index, text in enumerate(literals) if _is_free(text)]
        self._pattern, keys = found
        self._kinds = list(map(_kind, keys))
        marks = Marks(_values(keys))
        written = [
            _written(literals[place], before, marks.values[number])
            for (place, before), number in zip(places.items(), self._pattern, strict=True)
        ]
        self._columns = Columns(parts, places)
        self._columns.to_marks = self._columns.shifts(written) or []
        marked = list(parts)
        for index, text in zip(places, written, strict=True):
            marked[2 * index + 1] = text
        for index in self._comments:  # which may be more: f"{x["#"]}", "y"
            marked[2 * index + 1] = f"#{MARK}"
        self._code = CodeForm(
            code, compile("".join(marked), "a form", "exec", dont_inherit=True), marks, self._columns
        )
        self._taken = self._code.fixed | {(Name, word) for word in words}
        self.told = {look: LOOKS[look](code, b"") for look in _ASKING_NO_TEXT}
        if len(marks.seen) != len(marks.values):
            raise ValueError("a literal has become no constant")

    def code(self, path: str, literals: Sequence[str], *, are_plain: bool = False) -> CodeType | None:
        """Return the code of a text with these literals at a path; None where the form says nothing of it.

        `are_plain` says that all texts among them are.
        """
        if [literals[index] for index in self._fixed] != self._same:
            return None
        if not all(_is_free(literals[index]) for index in self._comments):
            return None
        own = [literals[index] for index in self._places]
        texts = own.copy()
        for number, before in self._names:
            if not own[number].isdigit():  # but a text with a letter before it
                return None
            texts[number] = before + own[number]
        found = classes(texts, are_plain=are_plain)
        if found is None:
            return None
        pattern, keys = found
        if pattern != self._pattern or not self._taken.isdisjoint(keys):
            return None
        if list(map(_kind, keys)) != self._kinds:
            return None
        try:
            return self._code.made(path, _values(keys), self._columns.shifts(own))
        except ValueError:
            self._pattern = []  # of no other one either
            return None


def _kind(key: Any) -> type[Any]:
    kind: type[Any] = str if type(key) is str else key[0]
    return kind


def _values(keys: Sequence[Any]) -> list[Any]:
    return [key if type(key) is str else Name(key[1]) if key[0] is Name else key[1] for key in keys]


def _written(literal: str, before: str, mark: object) -> str:
    if isinstance(mark, Name):
        return mark[len(before) :]
    return f"{literal[0]}{mark}{literal[0]}" if isinstance(mark, str) else repr(mark)


FORMS: Final = Forms()
