"""Variables of functions that are set and never read, as their bytecode tells: it takes no syntax tree."""

from __future__ import annotations

from functools import cache
from itertools import compress
from types import FunctionType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import CodeType, ModuleType

_NIBBLE = 15  # of instructions with two variables each half of the argument is one


def has_idle_names(module: ModuleType) -> bool:
    """Return whether a function of a launch file may have such variables."""
    return any(
        _is_idle(item.__code__)
        for item in vars(module).values()
        if type(item) is FunctionType and item.__code__.co_filename == module.__file__
    )


def _is_idle(code: CodeType) -> bool:
    given = code.co_argcount + code.co_kwonlyargcount
    count = len(code.co_varnames)
    if count == given or (code.co_flags & _MORE_ARGUMENTS and count == given + 1):
        return False
    written = code.co_code
    single, double = _loading()
    operations, operands = written[::2], written[1::2]
    read = set(compress(operands, operations.translate(single)))
    for operand in compress(operands, operations.translate(double)):
        read |= {operand >> 4, operand & _NIBBLE}
    names = [
        name for index, name in enumerate(code.co_varnames) if index >= given and index & 255 not in read
    ]
    return any(not name.startswith("_") and name not in code.co_cellvars for name in names)


_MORE_ARGUMENTS = 4 | 8  # `*args` and `**kwargs`


@cache
def _loading() -> tuple[bytes, bytes]:
    """Return tables of the operations that read a variable, and of those that read or set two."""
    from opcode import opmap  # noqa: PLC0415 - once

    single, double = bytearray(256), bytearray(256)
    for name, number in opmap.items():
        if "LOAD_FAST" in name and number < len(single):
            table = double if name.count("_FAST") > 1 else single
            table[number] = 1
    return bytes(single), bytes(double)
