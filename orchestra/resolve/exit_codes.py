"""How a process may end and has not failed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.context import POISON, Poison

if TYPE_CHECKING:
    from orchestra.description.running import Running
    from orchestra.description.text import Template
    from orchestra.resolve.resolution import Resolution

_HIGHEST_STATUS = 255
_HIGHEST_SIGNAL = 64


def exit_codes(action: Running, run: Resolution) -> tuple[int, ...] | Poison | None:
    """Return the codes with which a process succeeds, None where an action says nothing of them."""
    if action.success_exit_codes is None:
        return None
    codes = [_code(code, run) for code in action.success_exit_codes]
    sound = tuple(code for code in codes if isinstance(code, int))
    return sound if len(sound) == len(codes) else POISON


def _code(written: Template, run: Resolution) -> int | Poison | None:
    """Return an exit status, or the negative number of a signal (waitpid(2))."""
    code = run.integer(written)
    if isinstance(code, int) and not -_HIGHEST_SIGNAL <= code <= _HIGHEST_STATUS:
        message = f"a process ends with a status from 0 to {_HIGHEST_STATUS}, not with {code}"
        run.problems.error(Code.BAD_VALUE, message, run.at(written.span))
        return POISON
    return code
