"""`set_env`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.context import Value

if TYPE_CHECKING:
    from orchestra.description.actions.set_env import SetEnv
    from orchestra.resolve.resolution import Resolution


def visit(action: SetEnv, run: Resolution) -> None:
    """Set an environment variable for what follows."""
    name, value = run.text(action.name), run.evaluate(action.value)
    if isinstance(name, str) and "=" in name:
        message = f"'{name}' cannot be the name of a variable: it holds '='"
        instead = name.partition("=")[0] if action.name.constant is not None else None
        run.problems.error(Code.BAD_NAME, message, run.place(action.name), suggestion=instead)
    elif isinstance(name, str) and isinstance(value, Value):
        run.scope.change(name, value.text, run.place(action.value), value.through)
    elif isinstance(name, str):
        run.found.lost.add(name)
