"""Calls with arguments that nobody takes: the keyword that is wrong, and the one that was meant."""

from __future__ import annotations

import ast
import inspect
import re
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.explanation import Explanation
from orchestra.compat.keywords import keyword_meant, parameters_of, shown
from orchestra.compat.literals import argument, call_at, keyword_span
from orchestra.compat.names_in_frames import value_of
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.syntax_trees import tree_of
from orchestra.errors import Code

if TYPE_CHECKING:
    from types import FrameType

    from orchestra.compat.place import Place

_UNEXPECTED: Final = re.compile(r"(\w+)\(\) got an unexpected keyword argument '(\w+)'")
_TWICE: Final = re.compile(r"got multiple values for (?:keyword )?argument '(\w+)'")
_CALLING: Final = ("function", "on_")  # arguments that functions are handed over to
_NAME: Final = re.compile(r"'\w+'")
_Parameter = inspect.Parameter


def explained(error: TypeError, frame: FrameType, place: Place) -> Explanation | None:
    """Return what is wrong with the arguments of a call; None where the fault is another."""
    call = call_at(place)
    called = None if call is None else value_of(call.func, frame)
    if call is None or not callable(called) or not _is_about(error, called):
        return None
    name: str = getattr(called, "__name__", "it")
    twice = _TWICE.search(str(error))
    if twice is not None:
        span = keyword_span(place, twice[1]) or place.span
        if not call.args and all(item.arg for item in call.keywords):
            # The class itself gives it to the one that it derives from.
            return Explanation(f"{name} has no argument '{twice[1]}'", Code.UNKNOWN_KEY, span)
        return Explanation(f"{name} is given '{twice[1]}' twice", Code.CONFLICTING_KEYS, span)
    parameters = {parameter.name: parameter for parameter in parameters_of(called)}
    keywords = [item.arg for item in call.keywords if item.arg is not None]
    unknown = next((item for item in keywords if item not in parameters), None)
    unexpected = _UNEXPECTED.search(str(error))
    if unexpected is not None:
        return _unknown(name, unknown or unexpected[2], parameters, place)
    return _missing(error, name, parameters, place)


def _is_about(error: TypeError, called: Any) -> bool:
    """Return whether it is this call that failed, and not one inside of it."""
    if called is None:
        return False
    if (getattr(called, "__module__", None) or "").startswith("orchestra.compat."):
        return True
    name = getattr(called, "__qualname__", None)
    return (
        callable(called) and name is not None and str(error).startswith((f"{name}()", f"{name}.__init__()"))
    )


def _unknown(name: str, key: str, parameters: dict[str, Any], place: Place) -> Explanation:
    meant = keyword_meant(key, parameters, ())
    span = keyword_span(place, key)
    message = f"{name} has no argument '{key}'"
    if span is None:  # it comes out of a mapping that is made elsewhere
        notes = () if meant is None else (f"did you mean '{meant}'?",)
        return Explanation(message, Code.UNKNOWN_KEY, notes=notes)
    return Explanation(message, Code.UNKNOWN_KEY, span, meant)


def _handed_over(place: Place) -> Rewritten | None:
    """Return the function alone where it is called in place of being handed over to what calls it."""
    tree, call = tree_of(place.file), call_at(place)
    if tree is None or call is None:
        return None
    for node in tree.nodes:
        match node:
            case ast.Call(keywords=words):
                if any((word.arg or "").startswith(_CALLING) and word.value is call for word in words):
                    return Rewritten(ast.unparse(call.func))
    return None


def _missing(error: TypeError, name: str, parameters: dict[str, Any], place: Place) -> Explanation | None:
    """Return what is wrong with a call whose keywords are known."""
    text = str(error)
    if "missing" in text and "required" in text:
        words = " and ".join(_NAME.findall(text))
        return Explanation(
            f"{name} needs {words}",
            Code.MISSING_KEY,
            place.span,
            _handed_over(place),
        )
    if "positional argument" in text:
        by_place = sum(item.kind is _Parameter.POSITIONAL_OR_KEYWORD for item in parameters.values())
        message = f"{name} takes {by_place or 'no'} argument{'s' * (by_place != 1)} without a name"
        notes = (f"it is written {name}({shown(parameters)})",)
        return Explanation(message, Code.WRONG_TYPE, argument(place, (f"*{by_place}",)).span, notes=notes)
    return None
