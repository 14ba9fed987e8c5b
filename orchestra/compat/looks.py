"""Whether a launch file may have certain mistakes, as a short look tells: to find them takes a syntax tree."""

from __future__ import annotations

import re
from functools import cache
from types import CodeType, FunctionType
from typing import TYPE_CHECKING, Final

from orchestra.compat.idle_names import may_have_idle_actions

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from types import ModuleType

    from orchestra.errors import Problems
    from orchestra.location import Span

_BYTE: Final = 0xFF
_PIECE: Final = 16  # names of a dictionary that are one constant, at most
_KEY: Final = re.compile(rb"""[{}]|(['"])([^'"\n\\]+)\1\s*:""")
_SIGN: Final = re.compile(rb"""oin(?:Substitution)?\((?:[^()]|\([^()]*\))*?,\s*['"]/""")
# A line outside of functions in which a dictionary may stand, or behind which a part of the same statement does.
_OUTSIDE: Final = re.compile(
    rb"\n(?!from |import |[#\s])(?:.*(?:\{|[(\[,\\][ \t\r]*$)"
    rb"|(?:async|class|el|except|finally|for|if|match|try|w[hi]))",
    re.MULTILINE,
)
# The end of a word in quotes, and the beginning of another one.
_SIDE_BY_SIDE: Final = re.compile(rb"""['"](?<=[^\s"'\\=:].)\s+['"][\w/-]""")
# A function that is given an event, by the names that people give it.
_OF_EVENT: Final = re.compile(rb"(?:lambda[ \t]+|def[ \t]+\w+\((?:self,[ \t]*)?)(?:\w*event\w*|_?ev?|evt)\b")
# An empty list or dictionary that may be the default of a parameter.
_EMPTY: Final = re.compile(rb"def [^\n:]*=[ \t]*(?:\[[ \t]*\]|\{[ \t]*\}|list\(\)|dict\(\))")
# Lines that compare, assert in brackets, or call a method of a text.
_COMPARED: Final = re.compile(rb"""\n[ \t]*+\w[\w.\[\]'"]*+[ \t]*+==""")
_ASSERTED: Final = re.compile(rb"assert[ \t]*\(")
_MADE: Final = re.compile(
    rb"\n[ \t]*+\w++\.(?:capitalize|casefold|format|lower|[lr]?strip|remove(?:pre|suf)fix|replace|title|upper)\("
)
_MAKING: Final = frozenset(
    [
        "capitalize",
        "casefold",
        "format",
        "lower",
        "lstrip",
        "removeprefix",
        "removesuffix",
        "replace",
        "rstrip",
        "strip",
        "title",
        "upper",
    ]
)
# A text that is an alternative, one by itself in brackets, one that something is.
_IN_QUOTES: Final = re.compile(
    rb"""\bor[ \t]+['"][^'"\n]*['"][ \t]*(?:\)|:|or\b|\n)|(?:\bin|=)[ \t]*\(['"][^'"\n]+['"]\)"""
)
_IS: Final = re.compile(rb"""\bis[ \t]+(?:not[ \t]+)?['"\d]""")
_ITERATORS: Final = frozenset({"filter", "map", "zip"})


class Compiled:
    """The code of a file, its text, and what short looks at both have told: it is kept with the code.

    A look that a file's functions are needed for is longer; what is told of the code as a whole may be more than that.
    """

    __slots__ = ("code", "source", "told")

    def __init__(self, code: CodeType, source: bytes, told: dict[str, bool]) -> None:
        self.code = code
        self.source = source
        self.told = told

    def may(self, look: str) -> bool:
        """Return what one of the `LOOKS` tells."""
        known = self.told.get(look)
        if known is None:
            known = self.told[look] = LOOKS[look](self.code, self.source)
        return known


def has_foreign(source: bytes) -> bool:
    """Return whether a substitution of another language may stand in the text of a file."""
    return b"$(" in source or b"'LaunchConfiguration(" in source or b'"LaunchConfiguration(' in source


def has_doubled_keys(module: ModuleType, source: bytes) -> bool:
    """Return whether a name may stand twice in a dictionary of a file, of which this is the text.

    The names of a short dictionary are one constant; those of a long one are added to it one after the other.
    """
    codes = (item.__code__ for item in vars(module).values() if type(item) is FunctionType)
    return _may_double([code for code in codes if code.co_filename == module.__file__], source)


def _may_double(own: list[CodeType], source: bytes) -> bool:
    if any(map(_repeats, own)):
        return True
    may_stand = any(map(_lists_names, own)) or _OUTSIDE.search(b"\n" + source) is not None
    return may_stand and source.count(b"':") + source.count(b'":') > _PIECE and _doubles(source)


def _repeats(code: CodeType) -> bool:
    """Return whether a text is twice in one constant."""
    for item in code.co_consts:
        if type(item) is tuple:
            if len(set(item)) < len(item) and _repeats_text(item):
                return True
        elif type(item) is CodeType and _repeats(item):
            return True
    return False


def _repeats_text(items: tuple[object, ...]) -> bool:
    """Return whether a text is twice among others, as numbers often are."""
    texts = [item for item in items if type(item) is str]
    return len(set(texts)) < len(texts)


def _lists_names(code: CodeType) -> bool:
    """Return whether a dictionary is made of names that are not one constant."""
    written = code.co_code
    adding, building = _instructions()
    if adding in written[::2] or building.search(written) is not None:
        return True
    return any(_lists_names(item) for item in code.co_consts if type(item) is CodeType)


@cache
def _instructions() -> tuple[int, re.Pattern[bytes]]:
    """Return the operation that adds to a dictionary, and the instructions that make one of several names at once."""
    from opcode import opmap  # noqa: PLC0415 - once

    several = b"[" + re.escape(bytes(range(2, _PIECE))) + b"]"
    return opmap["MAP_ADD"], re.compile(re.escape(bytes((opmap["BUILD_MAP"],))) + several)


def _doubles(source: bytes) -> bool:
    """Return whether a name stands twice between the same braces, as far as a look at the text tells."""
    around: list[set[bytes]] = []
    for sign in _KEY.finditer(source):
        key = sign[2]
        if key is None:
            if sign[0] == b"{":
                around.append(set())
            elif around:
                around.pop()
        elif around:
            if key in around[-1]:
                return True
            around[-1].add(key)
    return False


def has_late_roots(source: bytes) -> bool:
    """Return whether a later part of a path may begin with a slash."""
    return _SIGN.search(source) is not None


def has_joined_words(source: bytes) -> bool:
    """Return whether a word may stand in quotes right behind another one."""
    return _SIDE_BY_SIDE.search(source) is not None


def has_idle_logic(code: CodeType, source: bytes) -> bool:
    """Return whether a test may always be so, or a statement do nothing."""
    compares, makes = _does(code)
    if compares and any(sign.search(source) is not None for sign in (_IN_QUOTES, _COMPARED, _IS)):
        return True
    if makes and _MADE.search(source) is not None:
        return True
    return b"assert" in source and _ASSERTED.search(source) is not None


def _does(code: CodeType) -> tuple[bool, bool]:
    """Return whether code compares or loops, and whether it makes texts of others."""
    operations = code.co_code[::2]
    compares = any(number in operations for number in _comparing())
    makes = not _MAKING.isdisjoint(code.co_names)
    for item in code.co_consts:
        if type(item) is CodeType:
            inner = _does(item)
            compares, makes = compares or inner[0], makes or inner[1]
    return compares, makes


@cache
def _comparing() -> tuple[int, ...]:
    from opcode import opmap  # noqa: PLC0415 - once

    return tuple(opmap[name] for name in ("COMPARE_OP", "IS_OP", "CONTAINS_OP", "FOR_ITER"))


def _goes_through(code: CodeType) -> bool:
    """Return whether there is something that is gone through but once."""
    if code.co_name == "<genexpr>" or not _ITERATORS.isdisjoint(code.co_names) or _sets_again(code):
        return True
    return any(_goes_through(item) for item in code.co_consts if type(item) is CodeType)


def _sets_again(code: CodeType) -> bool:
    """Return whether a variable is set twice to what a call returns."""
    called, pairs = _calls()
    # The two variables of an instruction for both are half of its argument each.
    found = [
        place[2][0] >> 4 if place[1][0] in pairs else place[2][0] for place in called.finditer(code.co_code)
    ]
    return len(set(found)) < len(found)


@cache
def _calls() -> tuple[re.Pattern[bytes], bytes]:
    """Return what a call is and the instruction that sets a variable behind it, and those of these for two."""
    from opcode import opmap  # noqa: PLC0415 - once

    pairs = bytes(opmap[name] for name in ("STORE_FAST_LOAD_FAST", "STORE_FAST_STORE_FAST") if name in opmap)
    setting = re.escape(bytes((opmap["STORE_FAST"],)) + pairs)
    calls = re.escape(bytes(opmap[name] for name in ("CALL", "CALL_KW", "CALL_FUNCTION_EX") if name in opmap))
    return re.compile(b"[" + calls + b"].(?:\0.)*([" + setting + b"])(.)", re.DOTALL), pairs


def has_event_functions(source: bytes) -> bool:
    """Return whether a function may be called with what an event handler waits for."""
    has_handler = any(sign in source for sign in (b"OnProcess", b"OnShutdown", b"OnExecution"))
    return has_handler and _OF_EVENT.search(source) is not None


def _sets_tuples(code: CodeType, _source: bytes) -> bool:
    """Return whether a name is set to a tuple of one."""
    written = code.co_code
    loading, building, setting = _storing()
    if building.search(written) is not None:
        return True
    for number, item in enumerate(code.co_consts):
        if type(item) is CodeType:
            if _sets_tuples(item, b""):
                return True
        elif type(item) is tuple and len(item) == 1:
            # The number of a late constant is longer, which the instruction before says.
            place = written.find(bytes((loading, number & _BYTE)))
            while place >= 0:
                if place % 2 == 0 and written[place + 2] in setting:
                    return True
                place = written.find(bytes((loading, number & _BYTE)), place + 1)
    return False


@cache
def _storing() -> tuple[int, re.Pattern[bytes], bytes]:
    """Return the operation that loads a constant, the instructions that set a name to a tuple of one, and what sets."""
    from opcode import opmap  # noqa: PLC0415 - once

    setting = bytes(number for name, number in opmap.items() if name.startswith("STORE_") and number <= _BYTE)
    building = re.escape(bytes((opmap["BUILD_TUPLE"], 1))) + b"[" + re.escape(setting) + b"]"
    return opmap["LOAD_CONST"], re.compile(building, re.DOTALL), setting


def _changes_nothing(code: CodeType, _source: bytes) -> bool:
    # Here, because it is kept with the code.
    from orchestra.witness.harmless import changes_nothing  # noqa: PLC0415

    return changes_nothing(code)


def _may_be_misused(code: CodeType, source: bytes) -> bool:
    # Here, as above.
    from orchestra.compat.misused import may_be_misused  # noqa: PLC0415

    return may_be_misused(code, source)


# Each look by its name: whether a file may change something, or have mistakes of a kind.
LOOKS: Final[dict[str, Callable[[CodeType, bytes], bool]]] = {
    "harmless": _changes_nothing,
    "idle": may_have_idle_actions,
    "foreign": lambda _, source: has_foreign(source),
    "doubled": lambda code, source: _may_double([code], source),
    "roots": lambda _, source: has_late_roots(source),
    "joined": lambda _, source: has_joined_words(source),
    "tuples": _sets_tuples,
    "events": lambda _, source: has_event_functions(source),
    "logic": has_idle_logic,
    "through": lambda code, source: _EMPTY.search(source) is not None or _goes_through(code),
    "misused": _may_be_misused,
}
# By the looks that say whether a file may have such slips: the modules that tell of them.
OF_CODE: Final = {"misused": "misused"}
OF_TEXTS: Final = {
    "foreign": "foreign_substitutions",
    "roots": "late_roots",
    "joined": "joined_words",
    "tuples": "trailing_commas",
    "events": "event_functions",
    "through": "gone_through",
    "logic": "idle_logic",
}


def tell_slips(
    compiled: Compiled, kinds: Mapping[str, str], path: str, problems: Problems, chain: tuple[Span, ...]
) -> None:
    """Warn of the slips of some kinds in a file; `chain` are the includes on the way."""
    for look, module in kinds.items():
        if compiled.may(look):
            from importlib import import_module  # noqa: PLC0415 - only what may be a mistake needs it

            import_module(f"orchestra.compat.{module}").tell(path, problems, chain)
