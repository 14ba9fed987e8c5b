"""`arg`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.nearest import nearest
from orchestra.resolve.context import POISON, Evaluated, Value
from orchestra.resolve.model import ResolvedArgument

if TYPE_CHECKING:
    from orchestra.description.actions.arg import Arg
    from orchestra.description.text import Template
    from orchestra.resolve.resolution import Resolution


def visit(action: Arg, run: Resolution) -> None:
    """Declare a launch argument: a value that is already set stays, else the default counts."""
    name = _text(action.name)
    choices = _choices(action)
    variable = run.scope.variables.get(name)
    run.scope.ledger.declared.add(name)
    if variable is None:
        run.scope.ledger.defaulted.add(name)
        value = _default(action, name, run)
        run.scope.set(name, value, run.at(action.span))
    else:
        value = variable.value
        if variable.leaked_from is not None:
            run.scope.get(name, run.at(action.span))  # warns
    if isinstance(value, Value) and choices is not None and value.text not in choices:
        message = f"'{value.text}' is none of the values of '{name}': " + ", ".join(choices)
        run.problems.error(
            Code.NOT_A_CHOICE, message, value.location, suggestion=nearest(value.text, choices)
        )
        run.scope.set(name, POISON, run.at(action.span))
    if name not in run.frame.given:
        _record(action, name, value, choices, run)


def _default(action: Arg, name: str, run: Resolution) -> Evaluated:
    if action.default is not None:
        return run.evaluate(action.default) or POISON
    if not action.faulty and run.inputs.required:
        run.scope.ledger.missing.setdefault(name, run.at(action.name.span))
    return POISON


def _record(
    action: Arg, name: str, value: Evaluated | None, choices: tuple[str, ...] | None, run: Resolution
) -> None:
    default = action.default.raw if action.default is not None else None
    text = value.text if isinstance(value, Value) else None
    description = _text(action.description) if action.description is not None else None
    argument = ResolvedArgument(name, default, text, description, choices, run.at(action.span))
    run.found.arguments.setdefault(name, argument)


def _choices(action: Arg) -> tuple[str, ...] | None:
    written = [*(action.choices or ()), *(choice.value for choice in action.choice or ())]
    return tuple(_text(item) for item in written) if written else None


def _text(template: Template) -> str:
    return template.constant or ""
