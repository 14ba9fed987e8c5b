"""`set_env`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.context import Value
from orchestra.resolve.environment_names import is_faulty_name, warn_of_shell

if TYPE_CHECKING:
    from orchestra.description.actions.set_env import SetEnv
    from orchestra.resolve.resolution import Resolution


def visit(action: SetEnv, run: Resolution) -> None:
    """Set an environment variable for what follows."""
    name, value = run.text(action.name), run.evaluate(action.value)
    if isinstance(name, str) and is_faulty_name(name, action.name, run):
        return
    warn_of_shell(action.value, run)
    if isinstance(name, str) and isinstance(value, Value):
        run.scope.change(name, value.text, run.place(action.value), value.through)
    elif isinstance(name, str):
        run.found.lost.add(name)
