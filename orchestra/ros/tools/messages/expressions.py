"""The parts of messages that a user names, and the conditions that he writes for them in Python."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

from orchestra.errors import RunError
from orchestra.nearest import nearest
from orchestra.ros.tools.messages.fields import fields_of, is_message

if TYPE_CHECKING:
    from collections.abc import Callable

_STEP: Final = re.compile(r"([A-Za-z_][A-Za-z0-9_]*)((?:\[-?[0-9]+\])*)")
_INDEX: Final = re.compile(r"\[(-?[0-9]+)\]")


def field_of(path: str) -> Callable[[Any], Any]:
    """Return what takes a part of a message by its path, as `pose.position.x` or `transforms[0]`.

    Raises `RunError` for no path; what it returns raises it for a part that a message has not.
    """
    steps: list[str | int] = []
    for word in path.split("."):
        found = _STEP.fullmatch(word)
        if found is None:
            raise RunError(f"'{path}' is no path of a field, as pose.position.x")
        steps += [found[1], *map(int, _INDEX.findall(found[2]))]

    def select(message: Any) -> Any:  # noqa: ANN401 - of any class
        for step in steps:
            message = _step(message, step, path)
        return message

    return select


def passes(expression: str | None) -> Callable[[Any], bool]:
    """Return whether an expression in Python holds for a message `m`. Raises `RunError` where it is none."""
    if expression is None:
        return lambda _message: True
    try:
        code = compile(expression, "--filter", "eval")
    except SyntaxError as error:
        raise RunError(f"the filter '{expression}' is no expression of Python: {error.msg}") from None

    def holds(message: Any) -> bool:  # noqa: ANN401 - as above
        try:
            return bool(eval(code, {"m": message}))  # noqa: S307 - the user's own
        except Exception as error:  # noqa: BLE001 - whatever the user's code raises
            raise RunError(f"the filter '{expression}' fails: {type(error).__name__}: {error}") from None

    return holds


def _step(value: Any, step: str | int, path: str) -> Any:  # noqa: ANN401 - as above
    if isinstance(step, int):
        try:
            return value[step]
        except (TypeError, IndexError, KeyError):
            raise RunError(f"{path}: there is no [{step}]") from None
    known = [name for name, _ in fields_of(type(value))] if is_message(value) else []
    if step not in known:
        near = nearest(step, known)
        hint = f"; did you mean {near}?" if near else f"; there are {', '.join(known)}" if known else ""
        raise RunError(f"{path}: there is no field {step}{hint}")
    return getattr(value, step)
