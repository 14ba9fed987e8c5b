"""Short looks at the code of a launch file that tell whether it may have slips of Python itself."""

from __future__ import annotations

import re
from bisect import bisect_left
from functools import cache
from itertools import chain, compress, repeat
from operator import attrgetter, is_
from types import CodeType
from typing import TYPE_CHECKING, Final

from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from typing import TypeVar

    _T = TypeVar("_T")

_BYTE: Final = 0xFF
# Lines that compare, assert in brackets, or call a method of a text.
_COMPARED: Final = re.compile(rb"""\n[ \t]*+\w[\w.\[\]'"]*+[ \t]*+==""")
_ASSERTED: Final = re.compile(rb"assert[ \t]*\(")
# Methods of texts that return another one.
METHODS_OF_TEXTS: Final = frozenset(
    {
        *("capitalize", "casefold", "format", "lower", "lstrip", "removeprefix", "removesuffix", "replace"),
        *("rstrip", "strip", "title", "upper"),
    }
)
_MADE: Final = re.compile(rb"\n[ \t]*+\w++\.(?:%b)\(" % "|".join(sorted(METHODS_OF_TEXTS)).encode())
# A text that is an alternative, one by itself in brackets, one that something is.
_IN_QUOTES: Final = re.compile(
    rb"""\bor[ \t]+['"][^'"\n]*['"][ \t]*(?:\)|:|or\b|\n)|(?:\bin|=)[ \t]*\(['"][^'"\n]+['"]\)"""
)
_IS: Final = re.compile(rb"""\bis[ \t]+(?:not[ \t]+)?['"\d]""")
# A function that is given an event, by the names that people give it.
_OF_EVENT: Final = re.compile(rb"(?:lambda[ \t]+|def[ \t]+\w+\((?:self,[ \t]*)?)(?:\w*event\w*|_?ev?|evt)\b")
# An empty list or dictionary that may be the default of a parameter.
_EMPTY: Final = re.compile(rb"def [^\n:]*=[ \t]*(?:\[[ \t]*\]|\{[ \t]*\}|list\(\)|dict\(\))")
_ITERATORS: Final = frozenset({"filter", "map", "zip"})
_CLOSING: Final = frozenset((b")", b"]", b"}"))
_ODD: Final = (b"\t", b"\r", b"\f", b"\v")  # blanks
_HANDLERS: Final = (b"nProcess", b"nShutdown", b"nExecution")  # behind the first letter, which is rare
# What is between two dictionaries side by side, and where a list of parameters begins.
_SIDE_BY_SIDE: Final = pattern(rb"\}\s{0,80},\s{0,80}\{")
_PARAMETERS: Final = pattern(rb"parameters\s{0,4}=\s{0,4}\[")
# What tells of the names in it: texts, which of them are keys, and brackets.
_IN_LIST: Final = pattern(rb"""(?:'([^'\\\n]*)'|"([^"\\\n]*)")\s*(:)?|#[^\n]*|[\[\]{}]""")
# Texts that have escapes or lines, or are put together.
_READ_OTHERWISE: Final = pattern(rb"""\\|'''|\"{3}|[\w.]['"]\s*[bfru]{0,2}['"]""")
_constants, _names, _written = map(attrgetter, ("co_consts", "co_names", "co_code"))


class Codes:
    """A code and those in it, with what looks ask of them: it is gathered without a step for each constant."""

    __slots__ = ("every", "names", "operations", "parts", "texts", "tuples", "written")

    def __init__(self, code: CodeType) -> None:
        self.every = every_code(code)
        self.written: list[bytes] = list(map(_written, self.every))
        self.operations = b"".join(self.written)[::2]
        self.names: set[str] = set(chain.from_iterable(map(_names, self.every)))
        constants = list(chain.from_iterable(map(_constants, self.every)))
        self.texts = list(_of_kind(str, constants))
        self.tuples = list(_of_kind(tuple, constants))
        self.parts: list[object] = list(chain.from_iterable(self.tuples))


def every_code(code: CodeType) -> list[CodeType]:
    """Return a code, and those of the functions and classes inside of it."""
    found = [code]
    for outer in found:
        found += _of_kind(CodeType, outer.co_consts)
    return found


def _of_kind(kind: type[_T], items: Iterable[object]) -> Iterator[_T]:
    return compress(items, map(is_, map(type, items), repeat(kind)))  # type: ignore[arg-type] # it has been asked


_last: list[tuple[CodeType, Codes]] = []


def codes_in(code: CodeType) -> Codes:
    """Return a code with those in it; several looks ask for those of one after the other."""
    if not _last or _last[0][0] is not code:
        _last[:] = [(code, Codes(code))]
    return _last[0][1]


def has_text(codes: Codes, *signs: str) -> list[bool]:
    """Return for each sign whether it is in a text among the constants, or in one of their tuples."""
    written = "".join(chain(codes.texts, _of_kind(str, codes.parts)))
    return [sign in written for sign in signs]


def has_idle_logic(code: CodeType, source: bytes) -> bool:
    """Return whether a test may always be so, or a statement do nothing."""
    codes = codes_in(code)
    compares = any(map(codes.operations.__contains__, _comparing()))
    if compares and any(sign.search(source) is not None for sign in (_IN_QUOTES, _COMPARED, _IS)):
        return True
    if not METHODS_OF_TEXTS.isdisjoint(codes.names) and _MADE.search(source) is not None:
        return True
    return b"assert" in source and _ASSERTED.search(source) is not None


@cache
def _comparing() -> tuple[int, ...]:
    from opcode import opmap  # noqa: PLC0415 - once

    return tuple(opmap[name] for name in ("COMPARE_OP", "IS_OP", "CONTAINS_OP", "FOR_ITER"))


def goes_through(code: CodeType, source: bytes) -> bool:
    """Return whether something may be gone through but once, or be one for several calls."""
    if _EMPTY.search(source) is not None:
        return True
    codes = codes_in(code)
    is_through = not _ITERATORS.isdisjoint(codes.names) or any(
        item.co_name == "<genexpr>" for item in codes.every
    )
    return is_through or any(map(_sets_again, codes.written))


def _sets_again(written: bytes) -> bool:
    """Return whether a variable is set twice to what a call returns."""
    called, pairs, setting = _calls()
    behind = [piece[:1] for sign in setting for piece in written.split(sign)[1:]]
    if not pairs and len(set(behind)) == len(behind):  # most are set once
        return False
    # The two variables of an instruction for both are half of its argument each.
    found = [place[2][0] >> 4 if place[1][0] in pairs else place[2][0] for place in called.finditer(written)]
    return len(set(found)) < len(found)


@cache
def _calls() -> tuple[re.Pattern[bytes], bytes, list[bytes]]:
    """Return what a call is and the instruction that sets a variable behind it, those of these for two, and all."""
    from opcode import opmap  # noqa: PLC0415 - once

    pairs = bytes(opmap[name] for name in ("STORE_FAST_LOAD_FAST", "STORE_FAST_STORE_FAST") if name in opmap)
    setting = bytes((opmap["STORE_FAST"],)) + pairs
    calls = re.escape(bytes(opmap[name] for name in ("CALL", "CALL_KW", "CALL_FUNCTION_EX") if name in opmap))
    called = re.compile(b"[" + calls + b"].(?:\0.)*([" + re.escape(setting) + b"])(.)", re.DOTALL)
    return called, pairs, [bytes((number,)) for number in setting]


def has_event_functions(_code: CodeType, source: bytes) -> bool:
    """Return whether a function may be called with what an event handler waits for."""
    has_handler = any(piece.startswith(_HANDLERS) for piece in source.split(b"O")[1:])
    return has_handler and _OF_EVENT.search(source) is not None


def gives_twice(source: bytes) -> bool:
    """Return whether two dictionaries in a list of parameters may both have a value for one name."""
    if b"},\n" not in source and b"}, {" not in source:
        return False
    begins = [found.end() for found in _PARAMETERS.finditer(source)]
    return _has_side_by_side(source, begins) and any(_has_twice(source, begin) for begin in begins)


def _has_side_by_side(source: bytes, begins: list[int]) -> bool:
    """Return whether two dictionaries stand side by side in one of the lists that begin there."""
    for found in _SIDE_BY_SIDE.finditer(source) if begins else ():
        at = found.start()
        index = bisect_left(begins, at)
        if index:
            begin = begins[index - 1]
            if source.count(b"]", begin, at) <= source.count(b"[", begin, at):  # the list has no end yet
                return True
    return False


def _has_twice(source: bytes, begin: int) -> bool:
    """Return whether two names in different dictionaries of the list that begins there may end in the same part."""
    ends: dict[bytes, int] = {}
    depth, index, end = 1, 0, begin
    for found in _IN_LIST.finditer(source, begin):
        first, end = found[0][:1], found.end()
        if found[3]:
            name = (found[1] or found[2] or b"").rpartition(b".")[2]
            if ends.setdefault(name, index) != index:
                return True
        elif first in b"[{":
            index += depth == 1
            depth += 1
        elif first in b"]}":
            depth -= 1
            if not depth:
                break
    return _READ_OTHERWISE.search(source, begin, end) is not None


def sets_tuples(code: CodeType, _source: bytes) -> bool:
    """Return whether a name is set to a tuple of one."""
    codes = codes_in(code)
    building = _storing()[0]
    if any(building.search(written) is not None for written in codes.written):
        return True
    return 1 in map(len, codes.tuples) and any(map(_sets_tuple, codes.every, codes.written))


def _sets_tuple(code: CodeType, written: bytes) -> bool:
    """Return whether a name is set to a tuple of one that is a constant."""
    kinds = written[::2].translate(_storing()[1])
    place = kinds.find(_SETS)
    while place >= 0:
        # The number of a late constant is longer, which the instruction before says.
        loaded = code.co_consts[written[2 * place + 1] :: _BYTE + 1]
        if any(type(item) is tuple and len(item) == 1 for item in loaded):
            return True
        place = kinds.find(_SETS, place + 1)
    return False


_LOADS, _STORES, _SETS = 1, 2, b"\1\2"


@cache
def _storing() -> tuple[re.Pattern[bytes], bytes]:
    """Return the instructions that set a name to a tuple of one, and a table of the operations that load and that set.

    A constant is loaded, names are set.
    """
    from opcode import opmap  # noqa: PLC0415 - once

    setting = bytes(number for name, number in opmap.items() if name.startswith("STORE_") and number <= _BYTE)
    building = re.escape(bytes((opmap["BUILD_TUPLE"], 1))) + b"[" + re.escape(setting) + b"]"
    table = bytes(_STORES if number in setting else 0 for number in range(_BYTE + 1))
    loading = opmap["LOAD_CONST"]
    table = table[:loading] + bytes((_LOADS,)) + table[loading + 1 :]
    return re.compile(building, re.DOTALL), table


def is_behind(source: bytes) -> bool:
    """Return whether something stands behind a return, as far in: what is no closing bracket, and no comment."""
    if any(map(source.__contains__, _ODD)):
        return _is_behind_one_of(source.splitlines())
    returns = list(_returns(source))
    following = [*returns[1:], (len(source), -1)]
    for (begin, far), (end, indent) in zip(returns, following, strict=False):
        found = _no_further_in(far).search(source, begin, end)
        if far == (indent if found is None else found.end() - found.start() - 2):
            return True
    return False


def _returns(source: bytes) -> Iterator[tuple[int, int]]:
    """Yield where each line begins that begins with a return, and how far in that is."""
    for at in places_of(b"return", source):
        begin = source.rfind(b"\n", 0, at) + 1
        if not source[begin:at].strip():
            yield begin, at - begin


@cache
def _no_further_in(far: int) -> re.Pattern[bytes]:
    """Return the first word of a line that stands so far in at most, but for closing brackets and comments."""
    return re.compile(rb"\n {0,%d}+[^ \n#)\]}]" % far)


def _is_behind_one_of(lines: Sequence[bytes]) -> bool:
    """Return what `is_behind` does of lines with blanks of several kinds."""
    far: int | None = None
    for line in lines:
        bare = line.lstrip()
        if far is None and not bare.startswith(b"return"):
            continue
        if not bare or bare[:1] == b"#":
            continue
        indent = len(line) - len(bare)
        if far is not None and indent <= far and bare[:1] not in _CLOSING:
            if indent == far:
                return True
            far = None
        if bare.startswith(b"return"):
            far = indent
    return False


def places_of(word: bytes, source: bytes) -> Iterator[int]:
    """Yield where a word stands: a pattern that begins with it would look for it for longer."""
    at = source.find(word)
    while at >= 0:
        yield at
        at = source.find(word, at + 1)
