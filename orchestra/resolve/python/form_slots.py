"""Where literals stand in the text of a Python file that decide nothing of its code but constants, and names nothing.

Such a literal is a whole element of a call, a list, a tuple or a dictionary, or all that a statement assigns: no
operator is applied to it, so that the compiler works nothing out with it, and whether it is true decides no jump. Such
a name ends with a number and is that of a variable of a function, which nothing else is called: `node_12`.
"""

from __future__ import annotations

import re
import sys
from keyword import iskeyword
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Sequence

# A comment, a text, a number, or that at the end of a name. Texts of one line without backslashes come first.
_LEXEME: Final = re.compile(
    r"""([\#"'0-9](?:
        (?<=")(?!"")[^"\\\n]*" | (?<=')(?!'')[^'\\\n]*' | (?<=\#)[^\n]* | (?<![\w.].)(?<=[0-9])[\w.]*
        | (?<=[A-Za-z_].)(?<=[0-9])[0-9]*(?!\w)
        | (?<=")""(?:[^"\\]|\\.|"(?!""))*"{3} | (?<=')''(?:[^'\\]|\\.|'(?!''))*'{3}
        | (?<=")(?:[^"\\\n]|\\.)*" | (?<=')(?:[^'\\\n]|\\.)*'
    ))""",
    re.DOTALL | re.VERBOSE,
)
_TOKEN: Final = re.compile(
    r"\n|[A-Za-z_][\w.]*|\*\*=?|//=?|<<=?|>>=?|->|[-+*/%@&|^=!<>:]=|\\\n|[^\s]", re.ASCII
)
_NAME: Final = re.compile(r"[A-Za-z_]\w*\Z", re.ASCII)
_WORD: Final = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_TEXT: Final = re.compile(r"""'[^'\\\n]*'|"[^"\\\n]*\"""")
QUOTES: Final = "'\""
_BEFORE: Final = frozenset("([{,=:")
_BEHIND: Final = frozenset(")]},:")
_OPENING: Final = frozenset("([{")
_CLOSING: Final = frozenset(")]}")
_PLAIN: Final = frozenset((*"()[]{},:=.\n", "->"))
_PLAIN_KEYWORDS: Final = frozenset(("from", "import", "as", "def", "return", "None", "True", "False"))
_OF_A_VALUE: Final = frozenset(")]}'\"")  # a bracket behind these looks into it
_ENDS_WITH_WORD: Final = re.compile(r"\w\Z")
_OPERATORS: Final = frozenset(
    ("%", "*", "**", "+", "-", "/", "//", "@", "|", "&", "^", "~", "<", ">", "<<", ">>")
)


def split(text: str) -> list[str]:
    """Return the parts of a text, one between literals and comments and one of those in turn."""
    return _LEXEME.split(text)


def is_plain(parts: Sequence[str]) -> bool:
    """Return whether a text that was split imports, defines functions, assigns, calls and returns, and nothing else.

    Then its code has no jumps, and the compiler works nothing out but signs of numbers and which values are constant.
    """
    before = ""
    for index in range(0, len(parts), 2):
        literal = parts[index + 1][0] if index + 1 < len(parts) else "\n"
        if literal in QUOTES and _ENDS_WITH_WORD.search(parts[index]):
            return False  # f'{name}', b'bytes'
        signs = _TOKEN.findall(parts[index])
        if literal.isdigit() and signs and signs[-1] == "-" and (signs[-2:-1] or [before])[0] in _BEFORE:
            del signs[-1]
        for sign in signs:
            words = () if sign in _PLAIN else sign.split(".")
            if not all(map(_is_plain_word, words)) or (sign == "[" and before in _OF_A_VALUE):
                return False
            before = sign
        before = before if literal in "#\n" else literal
    return True


def _is_plain_word(word: str) -> bool:
    return word.isidentifier() and (word in _PLAIN_KEYWORDS or not (iskeyword(word) or word == "match"))


def key_of(literal: str) -> Any:
    """Return the value of a literal, a number with its type, for 1 and 1.0 are two constants; a name as such.

    None where it is not plain: the same value may be written in several ways.
    """
    if literal[0] in QUOTES:
        return literal[1:-1] if _TEXT.fullmatch(literal) else None
    return number_of(literal) if literal[0].isdigit() else (Name, literal)


class Name(str):
    """The name of a variable."""

    __slots__ = ()


def number_of(literal: str) -> Any:
    """Return the value of a number with its type; None where it is written in another way than it is shown."""
    try:
        number = float(literal) if "." in literal else int(literal)
    except ValueError:
        return None
    return (type(number), number) if repr(number) == literal else None


def slots(parts: Sequence[str], variables: Collection[str]) -> tuple[dict[int, str], set[str]]:
    """Return the numbers of the literals, in a text that was split, whose values may be others, and of ends of names.

    With each goes what stands before it of the same name. Names are those of `variables`. Values are equal to none that
    may decide something, and to no other name, which are the second: that may be a constant too, as those of keywords
    are. So may 0 be, where nobody has written it.
    """
    names = dict(_ends_of_names(parts))
    keys = [
        None if part[0] == "#" or index in names else key_of(part) for index, part in enumerate(parts[1::2])
    ]
    found, words = _candidates(parts)
    full = {index: before + parts[2 * index + 1] for index, before in names.items()}
    words |= {name for name in full.values() if name not in variables}
    others = {key for index, key in enumerate(keys) if key is not None and index not in found}
    kept = others | words | {(int, 0), None}
    places = {index: "" for index in found if keys[index] not in kept}
    places |= {index: before for index, before in names.items() if full[index] not in words}
    texts = (part for index, part in enumerate(parts[1::2]) if index not in places and part[0] != "#")
    words.update(_WORD.findall(" ".join(texts)))  # code in texts: f"{node_12}"
    return dict(sorted(places.items())), words


def _ends_of_names(parts: Sequence[str]) -> Iterator[tuple[int, str]]:
    """Yield the numbers of what ends names, with what stands before."""
    for index, part in enumerate(parts[1::2]):
        before = _NAME.search(parts[2 * index]) if part.isdigit() else None
        if before is not None:
            yield index, before[0]


def _candidates(parts: Sequence[str]) -> tuple[dict[int, None], set[str]]:
    """Return the numbers of literals that stand where they decide nothing; and the words of the text."""
    found: dict[int, None] = {}
    words: set[str] = set()
    around: list[tuple[str, str, int]] = []
    before, last, closed = "\n", -1, sys.maxsize
    for index, part in enumerate(parts):
        if index & 1:
            if part[0] != "#":
                last, token, before = index, before, part
            continue
        for sign in _TOKEN.findall(part):
            if (sign == "\n" and around) or sign == "\\\n":
                continue
            if last >= 0:
                if _decides_nothing(parts[last], token, sign, around):
                    found[last // 2] = None
                last = -1
            _forget(found, closed, sign)
            closed = sys.maxsize
            if sign in _OPENING:
                around.append((sign, before, len(found)))
            elif sign in _CLOSING and around:
                _, outside, count = around.pop()
                closed = sys.maxsize if _is_named(outside) else count
            else:
                words.update(sign.split("."))
            before = sign
    return found, words


def _forget(found: dict[int, None], count: int, behind: str) -> None:
    """Keep so many of what was found where the compiler works something out with the rest: (1, 2)[0] + 3."""
    if behind == "[" or behind in _OPERATORS:
        while len(found) > count:
            found.popitem()


def _decides_nothing(literal: str, before: str, behind: str, around: Sequence[tuple[str, str, int]]) -> bool:
    """Return whether a literal is a whole element, by the tokens next to it and the brackets that are open there."""
    if not around:  # a statement that assigns it
        return before == "=" and behind == "\n"
    sign, outside, _ = around[-1]
    if before not in _BEFORE or behind not in _BEHIND or outside in _OPERATORS:
        return False
    if sign == "{" and ":" not in (before, behind):
        return False  # of a set, whose order depends on what is in it
    named = _is_named(outside)
    if sign == "[" and (named or outside in _CLOSING or outside[-1] in QUOTES):
        return named and literal[0] in QUOTES  # a subscript, else of what the compiler may look into
    return named or not (before == "(" and behind == ")")  # else in brackets alone


def _is_named(outside: str) -> bool:
    """Return whether a bracket behind a token calls or asks what has a name."""
    return (
        (outside[-1].isalnum() or outside[-1] == "_") and outside[0] not in QUOTES and not iskeyword(outside)
    )
