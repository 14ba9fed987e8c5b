"""Short looks at the code of a launch file that tell whether it may have slips of Python itself."""

from __future__ import annotations

import re
from functools import cache
from types import CodeType
from typing import Final

from orchestra.patterns import pattern

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
# Two dictionaries side by side in a list of parameters, and where such a list begins.
_SIDE_BY_SIDE: Final = pattern(rb"parameters\s{0,4}=\s{0,4}\[[^\]]{0,800}\}\s{0,80},\s{0,80}\{")
_PARAMETERS: Final = pattern(rb"parameters\s{0,4}=\s{0,4}\[")
# What tells of the names in it: texts, which of them are keys, and brackets.
_IN_LIST: Final = pattern(rb"""(?:'([^'\\\n]*)'|"([^"\\\n]*)")\s*(:)?|#[^\n]*|[\[\]{}]""")
# Texts that have escapes or lines, or are put together.
_READ_OTHERWISE: Final = pattern(rb"""\\|'''|\"{3}|[\w.]['"]\s*[bfru]{0,2}['"]""")


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
    makes = not METHODS_OF_TEXTS.isdisjoint(code.co_names)
    for item in code.co_consts:
        if type(item) is CodeType:
            inner = _does(item)
            compares, makes = compares or inner[0], makes or inner[1]
    return compares, makes


@cache
def _comparing() -> tuple[int, ...]:
    from opcode import opmap  # noqa: PLC0415 - once

    return tuple(opmap[name] for name in ("COMPARE_OP", "IS_OP", "CONTAINS_OP", "FOR_ITER"))


def goes_through(code: CodeType, source: bytes) -> bool:
    """Return whether something may be gone through but once, or be one for several calls."""
    return _EMPTY.search(source) is not None or _goes_through(code)


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


def has_event_functions(_code: CodeType, source: bytes) -> bool:
    """Return whether a function may be called with what an event handler waits for."""
    has_handler = any(sign in source for sign in (b"OnProcess", b"OnShutdown", b"OnExecution"))
    return has_handler and _OF_EVENT.search(source) is not None


def gives_twice(source: bytes) -> bool:
    """Return whether two dictionaries in a list of parameters may both have a value for one name."""
    if (b"}, {" not in source and b"},\n" not in source) or _SIDE_BY_SIDE.search(source) is None:
        return False
    return any(_has_twice(source, found.end()) for found in _PARAMETERS.finditer(source))


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


def sets_tuples(code: CodeType, _source: bytes = b"") -> bool:
    """Return whether a name is set to a tuple of one."""
    written = code.co_code
    loading, building, setting = _storing()
    if building.search(written) is not None:
        return True
    for number, item in enumerate(code.co_consts):
        if type(item) is CodeType:
            if sets_tuples(item):
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
