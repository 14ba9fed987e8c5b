"""Processes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.frontend.reading.attributes import texts, value_or_text, values, variables
from orchestra.compat.launch.frontend.reading.words import words
from orchestra.compat.launch.frontend.tags import class_of_tag

if TYPE_CHECKING:
    from orchestra.compat.launch.frontend.entity import Entity

_TEXTS = {"cwd": "cwd", "name": "name", "launch-prefix": "prefix"}
_VALUES = {"shell": bool, "emulate_tty": bool, "respawn_delay": float, "respawn_max_retries": int}
_DURATIONS = ("sigterm_timeout", "sigkill_timeout")


def execute_process(entity: Entity, parser: Any, ignored: frozenset[str]) -> dict[str, Any]:
    """Return a command and how it is run."""
    found = execute_local(entity, parser, ignored)
    names = {name: keyword for name, keyword in _TEXTS.items() if name not in ignored}
    found |= texts(entity, parser, names, optional=True)
    if "cmd" not in ignored:
        found["cmd"] = words(entity, "cmd", parser)
    if "env" not in ignored:
        environment = variables(entity, parser, "env")
        found |= {"additional_env": environment} if environment else {}
    return found


def execute_local(entity: Entity, parser: Any, ignored: frozenset[str]) -> dict[str, Any]:
    """Return how a process is run."""
    names = {name: name for name in ("output", "respawn") if name not in ignored}
    found = texts(entity, parser, names, optional=True)
    found |= values(entity, {name: kind for name, kind in _VALUES.items() if name not in ignored})
    if found.get("respawn_delay", 0.0) < 0:
        raise ValueError(_negative(entity, "respawn_delay"))
    for name in _DURATIONS:
        if name not in ignored:
            found |= _duration(entity, parser, name)
    if "on_exit" not in ignored:
        found |= _on_exit(entity)
    return found


def _duration(entity: Entity, parser: Any, name: str) -> dict[str, Any]:
    """Return a number of seconds as a text, which the class takes. Raises `ValueError` for a negative one."""
    found = value_or_text(entity, parser, name, float)
    value = found.get(name)
    if not isinstance(value, float):
        return found
    if value < 0:
        raise ValueError(_negative(entity, name))
    return {name: str(value)}


def _negative(entity: Entity, name: str) -> str:
    return f"'{name}' of '{entity.type_name}' is a number of seconds, none below zero"


def _on_exit(entity: Entity) -> dict[str, Any]:
    word = entity.get_attr("on_exit", optional=True)
    if word is None:
        return {}
    if word != "shutdown":
        raise ValueError(f"'on_exit' of '{entity.type_name}' is 'shutdown', not '{word}'")
    return {"on_exit": [class_of_tag("shutdown")()]}
