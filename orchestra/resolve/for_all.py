"""Variables of a launch to which upstream gives a meaning of its own: they say something of all processes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.booleans import boolean
from orchestra.resolve.context import POISON, Poison, Value

if TYPE_CHECKING:
    from orchestra.description.running import Running
    from orchestra.resolve.resolution import Resolution


def set_for_all(name: str, run: Resolution) -> Value | None:
    """Return the value of such a variable."""
    variable = run.scope.variables.get(name)
    return variable.value if variable is not None and isinstance(variable.value, Value) else None


def emulate_tty(action: Running, run: Resolution) -> bool | Poison | None:
    """Tell whether a process is given a terminal; what is said for all counts more than its own word."""
    setting = set_for_all("emulate_tty", run)
    if setting is None:
        return run.flag(action.emulate_tty)
    flag = boolean(setting.text)
    if flag is not None:
        return flag
    message = f"'emulate_tty' is true or false, not '{setting.text}'"
    run.problems.error(Code.BAD_VALUE, message, setting.location)
    return POISON
