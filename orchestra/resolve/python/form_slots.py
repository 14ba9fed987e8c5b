"""Where literals stand in the text of a Python file that decide nothing of its code but constants, and names nothing.

Such a literal is a whole element of a call, a list, a tuple or a dictionary, or all that a statement assigns, in a
statement that makes, calls, goes through or returns things and does nothing else. No operator is applied to it but +
with what has a name, so that the compiler works nothing out with it, and whether it is true decides no jump. A number
may have a sign, and what numbers come to is one literal with its operators (`12 + 0.5`), as it is one constant. Such a
name ends with a number, is that of a variable of a function, which nothing else is called (`node_12`), and all
statements of its file are like that.

All of this is told by the text in which each literal is as short as it can be; what stands in quotes says nothing.
"""

from __future__ import annotations

import re
from keyword import iskeyword, kwlist
from operator import add, mul, sub, truediv
from typing import TYPE_CHECKING, Any, Final

from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Sequence

# A comment, a text, a number or what several come to, or a number at the end of a name. Texts of one line without
# backslashes come first.
_LEXEME: Final = re.compile(
    r"""([\#"'0-9-](?:
        (?<=")(?!"")[^"\\\n]*" | (?<=')(?!'')[^'\\\n]*' | (?<=\#)[^\n]*
        | (?:(?<=-)[0-9] | (?<![\w.].)(?<=[0-9]))
            (?:[0-9]*(?:\.[0-9]+)?\ *[-+*/]\ *[0-9]+(?:\.[0-9]+)?(?![\w.]|\ *[-+*/])
            | [0-9.]*[eE]-[0-9]+(?!\w) | [\w.]*)
        | (?<=[A-Za-z_].)(?<=[0-9])[0-9]*(?!\w)
        | (?<=")""(?:[^"\\]|\\.|"(?!""))*"{3} | (?<=')''(?:[^'\\]|\\.|'(?!''))*'{3}
        | (?<=")(?:[^"\\\n]|\\.)*" | (?<=')(?:[^'\\\n]|\\.)*'
    ))""",
    re.DOTALL | re.VERBOSE,
)
QUOTES: Final = "'\""
_NAME: Final = re.compile(r"[A-Za-z_]\w*\Z", re.ASCII)
_WORD: Final = re.compile(r"[A-Za-z_]\w*", re.ASCII)
# A text in braces that holds nothing but names, calls and the like.
_OF_BRACES: Final = "fF"
_SUM: Final = pattern(r"(-?[0-9]{1,15}(?:\.[0-9]{1,15})?) *([-+*/]) *([0-9]{1,15}(?:\.[0-9]{1,15})?)")
_OPERATORS: Final = {"+": add, "-": sub, "*": mul, "/": truediv}
_FLAT: Final = pattern(r"""(["'])(?:""|'')?(?:[^{}'"\\]|\{[^{}'"\\]*\})*["']+""")
# Without literals and blanks: signs of plain statements, of numbers and of what a function returns, and what is not
# plain of that.
_PLAIN: Final = b'()[]{},:=.+"$_0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ'
_SIGNED: Final = tuple(f"{before}-0" for before in "([{,=:")
_NOT_PLAIN: Final = ("==", ":=", "+=", ")[", "][", "}[", '"[')
_PLUS: Final = pattern(r"\+")
# For a text in braces, which is like a call of names, and for one of several lines, which is not plain.
_IN_BRACES: Final = '$""'
_IN_LINES: Final = '@""'
_SHORT: Final = {"#": "", "-": "-0"}  # by how they begin: comments, and numbers that have a sign
_ENDING: Final = pattern(r"[()\[\]{}\n]")
_KEYWORDS: Final = frozenset(kwlist) - {
    *("from", "import", "as", "def", "return", "None", "True", "False", "for", "in")
}
_PATTERNS: Final = frozenset({"match", "case"})
_FAR: Final = 200  # what is further away is not looked for
_BEFORE: Final = frozenset("([{,=:")
_BEHIND: Final = frozenset(")]},:")


def split(text: str) -> list[str]:
    """Return the parts of a text, one between literals and comments and one of those in turn."""
    return _LEXEME.split(text)


class Name(str):
    """The name of a variable."""

    __slots__ = ()


def key_of(literal: str) -> Any:
    """Return the value of a literal, a number with its type, for 1 and 1.0 are two constants.

    None where it is not plain: the same value may be written in several ways.
    """
    if literal[0] in QUOTES:
        text = literal[1:-1]
        return None if literal[0] in text or "\\" in text or "\n" in text else text
    return number_of(literal) or sum_of(literal)


def number_of(literal: str) -> Any:
    """Return the value of a number with its type; None where it is written in another way than it is shown."""
    try:
        number = float(literal) if "." in literal else int(literal)
    except ValueError:
        return None
    return (type(number), number) if repr(number) == literal else None


class Sum(float):
    """What two numbers come to that are written with an operator between them."""

    __slots__ = ()


def sum_of(literal: str) -> Any:
    """Return what two numbers come to, with its type; None where it is nothing, or written in another way."""
    found = _SUM.fullmatch(literal)
    if found is None:
        return None
    first, second = map(number_of, found.group(1, 3))
    if first is None or second is None or (found[2] == "/" and not second[1]):
        return None
    number = _OPERATORS[found[2]](first[1], second[1])
    return type(number), number


def is_sum(literal: str) -> bool:
    """Return whether a number is written as what two come to."""
    return not _OPERATORS.keys().isdisjoint(literal[1:]) and _SUM.fullmatch(literal) is not None


class Slots:
    """The literals and ends of names of a text that was split that may be others."""

    def __init__(self, parts: Sequence[str], variables: Collection[str]) -> None:
        """Look at a text; names are those of `variables`. Raises `ValueError` where there may be no others in it."""
        self._parts = parts
        self._variables = variables
        self._text, self._places = _bare(parts)
        words = set(_WORD.findall(self._text))
        if "\\" in self._text or not words.isdisjoint(_PATTERNS):
            raise ValueError("there is what is not looked into")
        is_plain = _is_plain(self._text)
        self._kept = [] if is_plain else list(_kept(self._text))
        self.is_plain = is_plain and "for" not in words and "+" not in self._text and "$" not in self._text

    def at(self, indices: Iterable[int]) -> tuple[dict[int, str | None], set[Any]]:
        """Return what stands before each of some literals of the same name, None for comments; and values of others.

        Those are what nothing else may be. Raises `ValueError` where a literal decides something.
        """
        found = {index: self._before(index) for index in indices}
        literals = {text for index, text in enumerate(self._parts[1::2]) if index not in found}
        others = {key_of(text) for text in literals if text[0] != "#"}
        names = {f"{before}{self._parts[2 * index + 1]}" for index, before in found.items() if before}
        words = set(_WORD.findall("".join(self._parts))) - names if names else ()
        return found, others | {(int, 0), *((Name, word) for word in words)}

    def _before(self, index: int) -> str | None:
        literal = self._parts[2 * index + 1]
        if literal[0] == "#":
            return None
        name = _NAME.search(self._parts[2 * index]) if literal.isdigit() else None
        if name is not None:
            if self.is_plain and name[0] + literal in self._variables:
                return name[0]
            raise ValueError("a name that is known elsewhere")
        if key_of(literal) is None or not self._decides_nothing(self._places[index], literal):
            raise ValueError("a literal decides something")
        return ""

    def _decides_nothing(self, place: int, literal: str) -> bool:
        """Return whether what stands at a place is a whole element, by what stands next to it."""
        is_text = literal[0] in QUOTES
        if any(begin <= place < end for begin, end in self._kept):
            return False
        before = self._text[max(place - _FAR, 0) : place].rstrip()
        rest = self._text[place + (2 if is_text or literal[0] == "-" else 1) : place + _FAR].lstrip(" \t")
        last, behind = before[-1:], rest.lstrip()[:1]
        if not is_sum(literal):
            if last == "+" and _ends_with_name(before[:-1]):
                last = "="
            if behind == "+" and _begins_with_name(rest.lstrip()[1:]):
                behind = ","
        if last == "=" and rest[:1] == "\n":  # of a statement, or a call that goes on
            # What is asked of -5 is asked of 5, and has the sign then.
            return is_text or behind not in ("", ".")
        if last not in _BEFORE or behind not in _BEHIND or not (last and behind):
            return False
        if last not in "([":
            return True
        is_named = _ends_with_name(before[:-1])
        if last == "[":
            return is_text or not is_named
        return is_named or behind != ")"


def _bare(parts: Sequence[str]) -> tuple[str, list[int]]:
    """Return a text that was split without comments, its literals as short as can be, and where each is.

    Raises `ValueError` where there are texts of other kinds than plain ones and simple ones in braces.
    """
    found, places = [], []
    at = 0
    before = ""
    for index, part in enumerate(parts):
        bare = part
        if index & 1:
            places.append(at)
            if part[0] in QUOTES:
                bare = '""' if not (before.isalnum() or before == "_") else _in_braces(parts[index - 1], part)
            else:
                bare = _SHORT.get(part[0], "0")
        else:
            before = part[-1:]
        found.append(bare)
        at += len(bare)
    return "".join(found), places


def _in_braces(before: str, literal: str) -> str:
    is_alone = before[-1:] in _OF_BRACES and not (before[-2:-1].isalnum() or before[-2:-1] == "_")
    if not is_alone or _FLAT.fullmatch(literal) is None:
        raise ValueError("a text of another kind")
    return _IN_LINES if "\n" in literal else _IN_BRACES


def _is_plain(text: str) -> bool:
    """Return whether what has no literals imports, defines functions, assigns, calls, returns, goes through things.

    The compiler works nothing out in it but signs of numbers and which values are constant; it asks for no truth.
    """
    bare = "".join(text.split()).replace("->", "")
    if "-" in bare:
        for signed in _SIGNED:
            bare = bare.replace(signed, signed[0])
    if bare.encode().translate(None, _PLAIN) or any(sign in bare for sign in _NOT_PLAIN):
        return False
    if not all(_has_name_beside(text, sign.start()) for sign in _PLUS.finditer(text)):
        return False
    words = _WORD.findall(text)
    return _KEYWORDS.isdisjoint(words) and words.count("for") == words.count("in")


def _has_name_beside(text: str, place: int) -> bool:
    """Return whether what is added at a place is no constant on one side, as a name there tells."""
    return _ends_with_name(text[max(place - _FAR, 0) : place]) or _begins_with_name(
        text[place + 1 : place + _FAR]
    )


def _ends_with_name(text: str) -> bool:
    word = _NAME.search(text.rstrip())
    return word is not None and not iskeyword(word[0])


def _begins_with_name(text: str) -> bool:
    word = _WORD.match(text.lstrip())
    return word is not None and not iskeyword(word[0])


def _kept(text: str) -> Iterator[tuple[int, int]]:
    """Yield where statements begin and end that are not plain."""
    begin = depth = 0
    for sign in _ENDING.finditer(text + "\n"):
        if sign[0] != "\n":
            depth += 1 if sign[0] in "([{" else -1
        elif depth == 0:
            if not _is_plain(text[begin : sign.end()]):
                yield begin, sign.end()
            begin = sign.end()
