"""Calls with arguments that nobody takes: the keyword that is wrong, and the one that was meant."""

from __future__ import annotations

import ast
import inspect
import re
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.explanation import Explanation
from orchestra.compat.literals import call_at, keyword_span
from orchestra.errors import Code
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

    from orchestra.compat.place import Place

_UNEXPECTED: Final = re.compile(r"unexpected keyword argument '(\w+)'")
_NAME: Final = re.compile(r"'\w+'")
_Parameter = inspect.Parameter


def explained(error: TypeError, frame: FrameType, place: Place) -> Explanation | None:
    """Return what is wrong with the arguments of a call of ours; None where the fault is another."""
    call = call_at(place)
    called = None if call is None else _value_of(call.func, frame)
    if call is None or not _is_ours(called):
        return None
    name: str = getattr(called, "__name__", "it")
    parameters = {parameter.name: parameter for parameter in _parameters(called)}
    unknown = next((item for item in call.keywords if item.arg not in (None, *parameters)), None)
    if unknown is not None and unknown.arg is not None:
        return _unknown(name, unknown.arg, parameters, place, unknown)
    unexpected = _UNEXPECTED.search(str(error))
    if unexpected is not None:
        return _unknown(name, unexpected[1], parameters, place, None)
    return _missing(error, name, parameters, place)


def _is_ours(called: Any) -> bool:
    return (getattr(called, "__module__", None) or "").startswith("orchestra.compat.")


def _unknown(
    name: str, key: str, parameters: dict[str, Any], place: Place, written: ast.keyword | None
) -> Explanation:
    meant = nearest(key, parameters)
    if written is None:  # it comes out of a mapping
        notes = () if meant is None else (f"did you mean '{meant}'?",)
        return Explanation(f"{name} has no argument '{key}'", Code.UNKNOWN_KEY, notes=notes)
    span = keyword_span(place, written)
    return Explanation(f"{name} has no argument '{key}'", Code.UNKNOWN_KEY, span, meant)


def _missing(error: TypeError, name: str, parameters: dict[str, Any], place: Place) -> Explanation | None:
    """Return what is wrong with a call whose keywords are known."""
    text = str(error)
    if "missing" in text and "required" in text:
        words = " and ".join(_NAME.findall(text))
        return Explanation(f"{name} needs {words}", Code.MISSING_KEY, place.span)
    if "positional argument" in text:
        by_place = sum(item.kind is _Parameter.POSITIONAL_OR_KEYWORD for item in parameters.values())
        shown = ", ".join(f"{item}=..." for item in list(parameters)[:2])
        message = f"{name} takes {by_place or 'no'} argument{'s' * (by_place != 1)} without a name"
        notes = (f"it is written {name}({shown})",)
        return Explanation(message, Code.WRONG_TYPE, place.span, notes=notes)
    return None


def _parameters(called: Any) -> Iterator[inspect.Parameter]:
    """Return what a function or a class takes: with `**kwargs` what the class takes that it derives from, too."""
    if not isinstance(called, type):
        yield from inspect.signature(called).parameters.values()
        return
    seen: set[str] = set()
    for kind in called.__mro__:
        constructor = vars(kind).get("__init__")
        if constructor is None:
            continue
        parameters = list(inspect.signature(constructor).parameters.values())[1:]
        open_ended = any(parameter.kind is _Parameter.VAR_KEYWORD for parameter in parameters)
        for parameter in parameters:
            named = parameter.kind not in (_Parameter.VAR_KEYWORD, _Parameter.VAR_POSITIONAL)
            if named and not parameter.name.startswith("_") and parameter.name not in seen:
                seen.add(parameter.name)
                yield parameter
        yield from (
            _Parameter(key, _Parameter.KEYWORD_ONLY, default=None)
            for key in vars(kind).get("_more_keywords", ())
        )
        if not open_ended:
            return


def _value_of(expression: ast.expr, frame: FrameType) -> Any:
    """Return what a name, or an attribute of one, stands for in a frame; None for anything else.

    `super().__init__` stands for the class of ours that the object in construction derives from.
    """
    if ast.unparse(expression) == "super().__init__":
        made = frame.f_locals.get(frame.f_code.co_varnames[0])
        return next((kind for kind in type(made).__mro__ if _is_ours(kind)), None)
    if isinstance(expression, ast.Attribute):
        return getattr(_value_of(expression.value, frame), expression.attr, None)
    if not isinstance(expression, ast.Name):
        return None
    return frame.f_locals.get(expression.id, frame.f_globals.get(expression.id))
