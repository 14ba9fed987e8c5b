"""Actions in variables of functions that are set and never read, as their bytecode tells: it takes no syntax tree."""

from __future__ import annotations

import re
from functools import cache
from itertools import compress, islice
from types import FunctionType
from typing import TYPE_CHECKING, Final

from orchestra.compat.signs import codes_in, every_code

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from types import CodeType, ModuleType

PROCESSES: Final = frozenset(
    {"ComposableNodeContainer", "ExecuteLocal", "ExecuteProcess", "LifecycleNode", "Node"}
)
ACTIONS: Final = PROCESSES | {
    *("GroupAction", "IncludeLaunchDescription", "LoadComposableNodes", "OpaqueFunction"),
    *("RegisterEventHandler", "RosTimer", "TimerAction"),
}
_NIBBLE: Final = 15  # of instructions with two variables each half of the argument is one


def has_idle_actions(module: ModuleType, source: bytes) -> bool:
    """Return whether a launch file, of which this is the text, may make actions that it keeps and never reads."""
    codes = [code for code in _codes(vars(module).values()) if code.co_filename == module.__file__]
    idle = {id(code): _idle_names(code) for code in codes}
    if not any(idle.values()):
        return False
    lines = source.splitlines()
    own = [
        item
        for item in vars(module).values()
        if isinstance(item, type) and item.__module__ == module.__name__
    ]
    methods = _codes(value for item in own for value in vars(item).values())
    every = (code for outer in (*codes, *methods) for code in every_code(outer))
    return any(_keeps_action(code, idle.get(id(code)), lines) for code in every)


def may_have_idle_actions(code: CodeType, source: bytes) -> bool:
    """Return whether that may be so of whatever the code of a file comes to."""
    lines: list[bytes] = []
    for inner in codes_in(code).every:
        idle = _idle_names(inner)
        if idle:
            lines = lines or source.splitlines()
            if _keeps_action(inner, idle, lines):
                return True
    return False


def _codes(values: Iterable[object]) -> Iterator[CodeType]:
    return (value.__code__ for value in values if type(value) is FunctionType)


def _keeps_action(code: CodeType, known: set[int] | None, lines: Sequence[bytes]) -> bool:
    """Return whether a variable that is never read is set to something that names an action.

    These are looked for where they are not `known`.
    """
    idle = _idle_names(code) if known is None else known
    positions, passed = code.co_positions(), 0
    for index in sorted({*_setting(code.co_code, idle)}) if idle else ():
        # What was done before it is to make the value. Most are set where a function begins.
        begin, end, *_ = next(islice(positions, index - 1 - passed, None))
        passed = index
        if begin is not None and any(map(_action().search, lines[begin - 1 : end or begin])):
            return True
    return False


def _setting(written: bytes, names: Iterable[int]) -> Iterator[int]:
    """Yield the numbers of the instructions that set one of these variables."""
    for name in names:
        for operation in _operations()[_SET]:
            yield from _places(written, operation, name)
        for operation in _operations()[_SET_AND_READ]:
            for operand in range(name << 4, (name << 4) + 16 if name <= _NIBBLE else 0):
                yield from _places(written, operation, operand)


def _idle_names(code: CodeType) -> set[int]:
    """Return the variables that are never read, by the lower byte of their numbers."""
    given = code.co_argcount + code.co_kwonlyargcount
    count = len(code.co_varnames)
    if count == given or (code.co_flags & _MORE_ARGUMENTS and count == given + 1):
        return set()
    written = code.co_code
    operations, operands = written[::2], written[1::2]
    read = set(compress(operands, operations.translate(_table(_READ))))
    if _operations()[_READ_TWICE] or _operations()[_SET_AND_READ]:  # newer Pythons have such
        for operand in compress(operands, operations.translate(_table(_READ_TWICE))):
            read |= {operand >> 4, operand & _NIBBLE}
        setting = operations.translate(_table(_SET_AND_READ))
        read |= {operand & _NIBBLE for operand in compress(operands, setting)}
    return {
        index & 255
        for index, name in enumerate(code.co_varnames)
        if index >= given
        and index & 255 not in read
        and not name.startswith("_")
        and name not in code.co_cellvars
    }


def _places(written: bytes, operation: int, operand: int) -> Iterator[int]:
    """Yield the numbers of an instruction in the code of a function."""
    instruction = bytes((operation, operand))
    at = written.find(instruction)
    while at >= 0:
        if not at % 2:
            yield at // 2
        at = written.find(instruction, at + 1)


@cache
def _action() -> re.Pattern[bytes]:
    return re.compile(rf"\b(?:{'|'.join(sorted(ACTIONS))})\b".encode())


_MORE_ARGUMENTS: Final = 4 | 8  # `*args` and `**kwargs`


@cache
def _table(kind: int) -> bytes:
    """Return a table of the operations of a kind."""
    return bytes(operation in _operations()[kind] for operation in range(_HIGHEST + 1))


@cache
def _operations() -> tuple[list[int], ...]:
    """Return the operations that do something to variables, by what they do."""
    from opcode import opmap  # noqa: PLC0415 - once

    kinds: tuple[list[int], ...] = ([], [], [], [])
    for name, number in opmap.items():
        if number <= _HIGHEST and "_FAST" in name and not name.startswith("DELETE"):
            kinds[_kind(name.count("LOAD_FAST"), name.count("STORE_FAST"))].append(number)
    return kinds


def _kind(reads: int, sets: int) -> int:
    if reads and sets:
        return _SET_AND_READ
    return _SET if sets else _READ_TWICE if reads > 1 else _READ


# Kinds of operations; one that sets two variables takes what it sets them to apart.
_READ, _READ_TWICE, _SET, _SET_AND_READ = range(4)
_HIGHEST: Final = 255
