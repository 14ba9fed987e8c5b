"""Code of the form that an argument takes, made of code that was refused: by what was said of it."""

from __future__ import annotations

import re
from inspect import Parameter, signature
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from orchestra.compat.forms_of_entities import (
    actions,
    answering,
    emitted,
    ending,
    event,
    handed_over,
    is_declaration,
    matching,
    misplaced,
    named_file,
    one,
    one_argument,
    signalled,
    transition,
    type_called,
    uncalled,
)
from orchestra.compat.forms_of_sets import as_list, as_pair, with_colon
from orchestra.compat.quoted import quoted

if TYPE_CHECKING:
    from collections.abc import Callable

_Form: TypeAlias = "Callable[[str, Any], str | None]"
_TWO: Final = 2
_OPEN: Final = (Parameter.VAR_KEYWORD, Parameter.VAR_POSITIONAL)
MEANT_TRUE: Final = frozenset({"1", "on", "t", "true", "y", "yes"})
MEANT_FALSE: Final = frozenset({"0", "f", "false", "n", "no", "off"})
_VARIABLE: Final = re.compile(r"""LaunchConfiguration\((?:variable_name=)?(["']\w+["'])\)""")
_DECIMAL: Final = re.compile(r"-?\d+(\.\d*)?(e-?\d+)?")


def form_meant(source: str, value: Any, message: str) -> str | None:
    """Return what was meant by an expression that has come to a value; None where a message has no such remedy."""
    if isinstance(value, type) and _is_ours(value) and source.rpartition(".")[2] == value.__name__:
        return f"{source}()" if _needs_nothing(value) else None
    form = next((form for part, form in _FORMS.items() if part in message), None)
    declared = getattr(value, "name", None) if is_declaration(value) else None
    if isinstance(declared, str) and form in _OF_VALUES:
        variable = f"LaunchConfiguration({declared!r})"
        return f"IfCondition({variable})" if form is _condition else variable
    return None if form is None else form(source, value)


def _as_text(source: str, value: Any) -> str | None:
    """Return a number or a truth value as a text of a launch file."""
    if isinstance(value, set):
        return as_list(source)
    if type(value) not in (bool, int, float):
        return None
    if source != repr(value):
        return repr(source) if _DECIMAL.fullmatch(source) else f"str({source})"
    return repr(source.lower() if isinstance(value, bool) else source)


def _plain_value(source: str, value: Any) -> str | None:
    """Return a path as the text that a parameter can be, and what numpy has as the numbers."""
    if isinstance(value, PurePath):
        return f"str({source})"
    return f"{source}.tolist()" if callable(getattr(value, "tolist", None)) else None


def _as_truth(source: str, value: Any) -> str | None:
    """Return a text or a number as a truth value."""
    if not isinstance(value, str | int):
        return None
    word = str(value).strip().lower()
    is_literal = source.strip("'\"") == str(value)
    return str(word in MEANT_TRUE) if word in MEANT_TRUE | MEANT_FALSE and is_literal else None


def _as_float(source: str, value: Any) -> str:
    """Return a whole number as one with a point."""
    return f"{source}.0" if source == repr(value) else f"float({source})"


def _as_number(source: str, value: Any) -> str | None:
    """Return a text that is a number without its quotes."""
    if not isinstance(value, str) or source[1:-1] != value:
        return None
    return value if _DECIMAL.fullmatch(value) else None


def _items(source: str, value: Any) -> str | None:  # noqa: ARG001 - as the others
    """Return the pairs of a dictionary."""
    return f"{source}.items()"


def _mapping(source: str, value: Any) -> str | None:
    """Return pairs as a dictionary."""
    if isinstance(value, set):
        return with_colon(source)
    try:
        plain = dict(map(_named_value, value) if isinstance(value, list) else value)
    except (TypeError, ValueError):
        return None
    is_literal = source[:1] == "[" and all(isinstance(each, str) for pair in plain.items() for each in pair)
    if is_literal:
        return repr(plain)
    are_pairs = not isinstance(value, list) or not any(isinstance(item, str | dict) for item in value)
    return f"dict({source})" if are_pairs else None


def _named_value(item: Any) -> Any:
    """Return the name and the value in `NAME=value`, in a dictionary with one key, and in one as YAML has it."""
    if isinstance(item, str):
        name, sign, value = item.partition("=")
        if not sign:
            raise ValueError(item)
        return name, value
    if isinstance(item, dict):
        if item.keys() == {"name", "value"}:
            return item["name"], item["value"]
        ((name, value),) = item.items()
        return name, value
    return item


def _words(source: str, value: Any) -> str | None:
    """Return a text with the words of a command line as a list of them."""
    if isinstance(value, set):
        return as_list(source)
    if isinstance(value, str):
        # Here, because only mistakes need it.
        from orchestra.compat.words_meant import words_meant  # noqa: PLC0415

        return words_meant(source, value)
    return f"[{source}]" if callable(getattr(value, "perform", None)) else None


def _condition(source: str, value: Any) -> str | None:
    """Return a condition that is made of what was given as one."""
    if isinstance(value, bool):
        return f"IfCondition({str(value).lower()!r})" if source == repr(value) else None
    if isinstance(value, str) or callable(getattr(value, "perform", None)):
        return f"IfCondition({source})"
    return None


def _remappings(source: str, value: Any) -> str | None:
    """Return remappings that are a dictionary as a list of pairs."""
    if not isinstance(value, dict):
        return None
    is_plain = source.startswith("{") and all(
        isinstance(item, str) for pair in value.items() for item in pair
    )
    return repr(list(value.items())) if is_plain else f"list({source}.items())"


def _pair(source: str, value: Any) -> str | None:
    """Return a remapping of the command line, or a list of two names, as that of a launch file."""
    if (
        isinstance(value, dict)
        and len(value) == _TWO
        and all(isinstance(name, str) for name in value.values())
    ):
        return repr(tuple(value.values()))  # `from` and `to`, as YAML has them, or other words for them
    if isinstance(value, set | dict):
        return as_pair(source)
    if not isinstance(value, str):
        is_list = isinstance(value, list) and len(value) == _TWO and source[:1] + source[-1:] == "[]"
        return f"({source[1:-1]})" if is_list else None
    name, _, target = value.partition(":=")
    return f"({name!r}, {target!r})"


def _one_of_many(source: str, value: Any) -> str:
    """Return a list of one thing."""
    is_list = isinstance(value, list) and source[:1] + source[-1:] == "[]"
    return f"[({source[1:-1]})]" if is_list else f"[{source}]"


def _parameters(source: str, value: Any) -> str | None:
    """Return parameters as a list of dictionaries and files."""
    if isinstance(value, tuple):
        return _brackets(source)
    return _one_of_many(source, value)


def _brackets(source: str) -> str:
    """Return a tuple as a list."""
    if source[:1] + source[-1:] == "()":
        return f"[{source[1:-1].strip().removesuffix(',')}]"
    return f"list({source})"


def _listed(source: str, value: Any) -> str | None:
    """Return the words that are a text or a tuple as a list."""
    return _brackets(source) if isinstance(value, tuple) else _words(source, value)


def _choices(source: str, value: Any) -> str | None:
    """Return a text with choices as a list of them."""
    if source[1:-1] != value:
        return None
    return repr(quoted(value) or re.split(r"[\s,|/]+", value.strip()))


def _pairs(source: str, value: Any) -> str | None:
    """Return a set of a name and its value as a dictionary."""
    return with_colon(source) if isinstance(value, set) else None


def _pairs_of(source: str, value: Any) -> str | None:
    """Return the same as the pairs of a dictionary."""
    made = _pairs(source, value)
    return None if made is None else f"{made}.items()"


def _name_of_variable(source: str, value: Any) -> str | None:
    """Return the name of the variable that stands in place of the name alone."""
    found = _VARIABLE.fullmatch(source)
    named = getattr(value, "variable_name", None)
    if found is None and isinstance(named, list) and len(named) == 1 and hasattr(named[0], "text"):
        return repr(named[0].text)
    return _as_text(source, value) if found is None else found[1]


def _name_and_value(source: str, value: Any) -> str | None:  # noqa: ARG001 - as the others
    """Return the pair of a dictionary of one."""
    return repr(next(iter(value.items()))) if isinstance(value, dict) and len(value) == 1 else None


def _nothing(source: str, value: Any) -> str | None:
    return "[]" if value is None and source == "None" else None


def _needs_nothing(kind: type[Any]) -> bool:
    """Return whether objects of a class can be made without arguments."""
    parameters = list(signature(kind.__init__).parameters.values())[1:]
    return not any(item.default is item.empty and item.kind not in _OPEN for item in parameters)


def _is_ours(kind: type[Any]) -> bool:
    """Return whether a class is one of the launch language."""
    return kind.__module__.startswith("orchestra.compat.")


_FORMS: Final[dict[str, _Form]] = {
    "the name of a launch argument is a text": _name_of_variable,
    " is a text, this is": _as_text,
    "expected a text": _as_text,
    " is True or False": _as_truth,
    " is a float, this is": _as_float,
    " is a number, this is": _as_number,
    " are pairs, this is a dict": _items,
    " are a dict, this is": _mapping,
    "an environment is a dict": _mapping,
    "of a launch argument is a text": _as_text,
    "expected a value, a substitution": _plain_value,
    "is no value of a parameter": _plain_value,
    "a parameter that is a list cannot hold": _plain_value,
    "a remapping is a tuple": _pair,
    " is a list of words, not": _words,
    "a condition is made by IfCondition": _condition,
    "remappings are a list of tuples of two names, not": _remappings,
    "this is one of them: ": _one_of_many,
    "parameters are a list of dictionaries and files, not ": _parameters,
    "'parameters' of a Node is a list, not ": _parameters,
    "'ros_arguments' of a Node is a list, not ": _listed,
    "choices of a launch argument are a list": _choices,
    " are pairs, this is a set": _pairs_of,
    "this is a set": _pairs,
    "a list of actions, not 'shutdown'": ending,
    "the event is launch.events": event,
    "a name and its value are expected": _name_and_value,
    "composable_node_descriptions is a list": one,
    "the args of an OpaqueFunction are a list": one_argument,
    "is a list, this is": actions,
    "are a list, this is": actions,
    "an event handler has ": emitted,
    "returns a list of actions or None": actions,
    "an action is expected here": misplaced,
    "a list of actions is expected": actions,
    "is a function of the event": answering,
    "is a predicate on actions": matching,
    "is one of signal.Signals": signalled,
    "is no transition of a lifecycle node": transition,
    "parameters are dictionaries and files, this is a pair": named_file,
    "parameters are dictionaries and files, this is a list": misplaced,
    "is not called": uncalled,
    "of an OpaqueFunction cannot be called": handed_over,
    "of None has no action": _nothing,
    "value_type is a type, this is": type_called,
}
# What stands where values do.
_OF_VALUES: Final = (_as_text, _plain_value, _as_truth, _as_float, _condition, _words)
