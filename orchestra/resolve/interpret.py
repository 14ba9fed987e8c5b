"""The depth-first visit of a description, in upstream's order: each action sees what came before it."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Any, Protocol

from orchestra.errors import Code
from orchestra.resolve.booleans import boolean
from orchestra.resolve.context import Poison
from orchestra.resolve.model import ResolvedSkip

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.entity import Action
    from orchestra.description.text import Template
    from orchestra.resolve.resolution import Resolution

VISITORS: dict[str, str] = {
    "Arg": "arg",
    "Executable": "executable",
    "Group": "group",
    "Include": "include",
    "Let": "let",
    "Log": "log",
    "Node": "node",
    "PushRosNamespace": "push_ros_namespace",
    "SetEnv": "set_env",
    "SetParameter": "set_parameter",
    "SetRemap": "set_remap",
    "Shutdown": "shutdown",
    "Timer": "timer",
    "UnsetEnv": "unset_env",
}


class Visitor(Protocol):
    """The behaviour of one action."""

    def visit(self, action: Any, run: Resolution) -> None:  # noqa: ANN401 - each visitor knows its own action
        """Carry the action out on the state of the resolution."""


def visit(actions: Sequence[Action], run: Resolution) -> None:
    """Visit actions in order, leaving out those whose condition says so."""
    for action in actions:
        if not _wanted(action, run):
            continue
        outer = run.conditional
        run.conditional |= action.if_ is not None or action.unless is not None
        _visitor(type(action).__name__).visit(action, run)
        run.conditional = outer


@cache
def _visitor(name: str) -> Visitor:
    visitor: Visitor = import_module(f"orchestra.resolve.actions.{VISITORS[name]}")
    return visitor


def _wanted(action: Action, run: Resolution) -> bool:
    template = action.if_ if action.if_ is not None else action.unless
    if template is None:
        return True
    value = run.evaluate(template)
    if value is None or isinstance(value, Poison):
        run.found.incomplete = True
        return False
    holds = boolean(value.text)
    if holds is None:
        run.found.incomplete = True
        message = f"a condition is true or false, this is '{value.text}'"
        run.problems.error(Code.BAD_CONDITION, message, value.location)
        return False
    if holds == (action.if_ is not None):
        return True
    _skip(action, template, value.text, run)
    return False


def _skip(action: Action, template: Template, value: str, run: Resolution) -> None:
    kind = VISITORS[type(action).__name__]
    run.found.hidden_include |= kind in {"include", "group"}
    name = getattr(action, "name", None) or getattr(action, "file", None)
    run.found.skipped.append(
        ResolvedSkip(
            kind,
            name.raw if name is not None else None,
            "if" if action.if_ is not None else "unless",
            template.raw,
            value,
            run.at(action.span),
        )
    )
