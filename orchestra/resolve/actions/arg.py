"""`arg`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.description.text import Call, Template
from orchestra.errors import Code, Severity
from orchestra.nearest import nearest
from orchestra.resolve.context import POISON, Evaluated, Value
from orchestra.resolve.declarations import declare, settle
from orchestra.resolve.mentions import glimpse
from orchestra.resolve.model import ResolvedArgument
from orchestra.resolve.refusals import refuse_value, report_unset_environment

if TYPE_CHECKING:
    from orchestra.description.actions.arg import Arg
    from orchestra.location import Location
    from orchestra.resolve.resolution import Resolution


def visit(action: Arg, run: Resolution) -> None:
    """Declare a launch argument: a value that is already set stays, else the default counts."""
    name, choices, at = _text(action.name), _choices(action), run.place(action)
    run.scope.ledger.declared.add(name)
    run.found.choices.setdefault(name, set()).add(choices)
    declare(action, name, choices, run)
    value = _value(action, name, at, run)
    _check_default(action, value, choices, run)
    if isinstance(value, Value) and choices is not None and value.text not in choices:
        if not _is_left_open(action, name, value, run):
            _refuse(name, value, choices, run)
        run.scope.set(name, POISON, at)
    settle(name, at, run)
    _record(action, name, value, choices, at, run)


def _value(action: Arg, name: str, at: Location, run: Resolution) -> Evaluated:
    """Return the value of the argument; one that an include has left behind is a surprise unless it is the default."""
    variable = run.scope.variables.get(name)
    if variable is not None and variable.leaked_from is None:
        return variable.value
    run.scope.ledger.defaulted.add(name)
    if variable is not None and not _is_default(action, variable.value, run):
        return run.scope.get(name, at) or POISON  # warns
    value = _default(action, name, run)
    run.scope.set(name, value, at, "default")
    return value


def _is_default(action: Arg, value: Evaluated, run: Resolution) -> bool:
    default = (
        glimpse(action.default, run.context, run.scope.variables) if action.default is not None else None
    )
    return default is not None and isinstance(value, Value) and default.text == value.text


def _check_default(action: Arg, value: Evaluated, choices: tuple[str, ...] | None, run: Resolution) -> None:
    """Report a default that is no choice, even where another value is given."""
    text = action.default.constant if action.default is not None else None
    if action.default is None or text is None or choices is None or text in choices:
        return
    if not isinstance(value, Value) or value.text != text:
        _refuse(_text(action.name), Value(text, run.at(action.default.span), verbatim=True), choices, run)


def _is_left_open(action: Arg, name: str, value: Value, run: Resolution) -> bool:
    """Tell what a default without a text lacks: `$(env ROBOT_MODEL '')` demands a variable that is set on the robot.

    Where that is an error anyway, it is told as the value that is none of the choices.
    """
    context = run.context
    if value.text or name not in run.scope.ledger.defaulted or context.weights.variable is Severity.ERROR:
        return False
    match action.default:
        case Template(parts=(Call(name="env", arguments=(written, _)),)):
            variable = written.constant
            if variable is None or context.environment.get(variable) is not None:
                return False
            report_unset_environment(variable, action.default, context)
            return True
    return False


def _refuse(name: str, value: Value, choices: tuple[str, ...], run: Resolution) -> None:
    message = f"'{value.text}' is none of the values of '{name}': " + ", ".join(choices)
    meant = nearest(value.text, choices)
    refuse_value(value, run.problems, Code.NOT_A_CHOICE, message, meant=meant)


def _default(action: Arg, name: str, run: Resolution) -> Evaluated:
    if action.default is not None:
        return run.evaluate(action.default) or POISON
    if not action.faulty and run.inputs.required:
        run.scope.ledger.missing.setdefault(name, run.at(action.name.span))
    return POISON


def _record(
    action: Arg,
    name: str,
    value: Evaluated | None,
    choices: tuple[str, ...] | None,
    at: Location,
    run: Resolution,
) -> None:
    default = action.default.raw if action.default is not None else None
    text = value.text if isinstance(value, Value) else None
    description = _text(action.description) if action.description is not None else None
    given = name in run.frame.given
    known = run.found.arguments.get(name)
    if given and run.frame.private:
        return
    if known is None or (known.given and not given):
        found = ResolvedArgument(name, default, text, description, choices, at, given)
        run.found.arguments[name] = found


def _choices(action: Arg) -> tuple[str, ...] | None:
    if any(choice.faulty or choice.value.faulty for choice in action.choice or ()):
        return None  # one of them is told to be wrong: nothing is known of the others
    written = [*(action.choices or ()), *(choice.value for choice in action.choice or ())]
    return tuple(_text(item) for item in written) if written else None


def _text(template: Template) -> str:
    return template.constant or ""
