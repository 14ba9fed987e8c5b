"""Conditions of Python that compare a launch configuration with a text, as a substitution of the launch language.

`LaunchConfigurationEquals` compares texts, `$(equals)` booleans and numbers first: where the text is one of those, a
sign in front of both sides makes them texts.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.conditions.launch_configuration_equals import LaunchConfigurationEquals
from orchestra.compat.launch.event_handler import is_of_ours
from orchestra.convert.mapped import mapped, with_parts
from orchestra.description.text import Call, Constant, Opaque, Template, Words

if TYPE_CHECKING:
    from orchestra.description.entity import Action

_SIGN = "="
_BOOLEANS = frozenset({"true", "false", "1", "0"})


def compared(actions: tuple[Action, ...]) -> tuple[Action, ...]:
    """Return the actions with substitutions for such conditions."""
    return tuple(mapped(action, _of) for action in actions)


def _of(value: Template | Constant) -> Template | Constant:
    return with_parts(value, _part) if isinstance(value, Template) else value


def _part(part: Any) -> tuple[Any, ...]:  # noqa: ANN401 - a part of a description, whatever it is
    if not isinstance(part, Opaque):
        return (part,)
    condition = getattr(part.target, "_condition", None)
    if not isinstance(condition, LaunchConfigurationEquals) or len(part.inside) == 1:
        return (part,)
    if not (is_of_ours(condition, "evaluate") and is_of_ours(condition, "_predicate_func")):
        return (part,)
    variable, expected = part.inside
    name = variable.parts[0].arguments[0] if isinstance(variable.parts[0], Call) else variable
    return (_comparison(name, expected, part, wanted=condition._wanted),)  # noqa: SLF001 - a class of ours


def _comparison(name: Template, expected: Template, part: Opaque, *, wanted: bool) -> Call:
    """Return the substitution; an unset variable is like no text that is asked for."""
    span = part.span
    text = expected.constant
    sign = _SIGN if text is None or _is_special(text) else ""
    unset = Template((), "", span) if text else Template((Words("-", span),), "-", span)
    variable = Call("var", (name, unset), span)
    left = Template((*_words(sign, part), variable), "", span)
    right = Template((*_words(sign, part), *expected.parts), "", span)
    return Call("equals" if wanted else "not-equals", (left, right), span)


def _words(text: str, part: Opaque) -> tuple[Words, ...]:
    return (Words(text, part.span),) if text else ()


def _is_special(text: str) -> bool:
    """Return whether `$(equals)` takes a text for more than a text."""
    try:
        float(text)
    except ValueError:
        return text.lower() in _BOOLEANS
    return True
