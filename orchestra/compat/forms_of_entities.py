"""Code of the form that is taken for an action, or for what is no value: made of code that was refused."""

from __future__ import annotations

import re
from signal import Signals
from typing import Any, Final

_CALLED: Final = re.compile(r"([\w.]+)\(.*\)")
_TWO: Final = 2
_MORE_ARGUMENTS: Final = 4  # `*args`
_COROUTINE: Final = 128
_TRANSITIONS: Final = ("ACTIVATE", "CLEANUP", "CONFIGURE", "CREATE", "DEACTIVATE", "DESTROY")

# What takes objects that are no actions, by the names of their classes.
_TAKING: Final = {
    "BaseEventHandler": "RegisterEventHandler(",
    "Event": "EmitEvent(event=",
    "LaunchDescriptionSource": "IncludeLaunchDescription(",
    "function": "OpaqueFunction(function=",
}

_TYPES: Final = {
    **{name: name for name in ("bool", "float", "int", "str")},
    "boolean": "bool",
    "double": "float",
    "integer": "int",
    "string": "str",
}


def is_declaration(value: Any) -> bool:
    """Return whether a value is the declaration of a launch argument, which people take for its value."""
    return any(kind.__name__ == "DeclareLaunchArgument" for kind in type(value).__mro__)


def ending(source: str, value: Any) -> str | None:  # noqa: ARG001 - as the others
    """Return the action that is called by a word."""
    return "Shutdown()" if value == "shutdown" else None


def event(source: str, value: Any) -> str | None:  # noqa: ARG001 - as the others
    """Return the event that has the name of an action."""
    return f"launch.events.{source.rpartition('.')[2]}" if source[:1].isupper() else None


def actions(source: str, value: Any) -> str | None:
    """Return a list of one action."""
    return f"[{source}]" if callable(getattr(value, "visit", None)) else None


def one(source: str, value: Any) -> str | None:
    """Return a list of one thing that is no list itself."""
    return f"[{source}]" if not isinstance(value, dict | list | set | str | tuple) else None


def one_argument(source: str, value: Any) -> str:  # noqa: ARG001 - as the others
    """Return a list of what is handed over alone."""
    return f"[{source}]"


def emitted(source: str, value: Any) -> str | None:
    """Return the action that lets an event happen which stands in place of one."""
    is_event = any(kind.__name__ == "Event" for kind in type(value).__mro__)
    return f"EmitEvent(event={source})" if is_event else actions(source, value)


def misplaced(source: str, value: Any) -> str | None:
    """Return the action that takes what stands in place of one."""
    if isinstance(value, list | tuple):
        is_literal = source[:1] + source[-1:] in ("[]", "()")
        return (source[1:-1].strip() or None) if is_literal else f"*{source}"
    if _needs_nothing(value):
        return f"{source}()"
    kinds = (_TAKING.get(kind.__name__) for kind in type(value).__mro__)
    taking = next((kind for kind in kinds if kind is not None), None)
    return None if taking is None else f"{taking}{source})"


def _needs_nothing(value: Any) -> bool:
    """Return whether a function takes no arguments: it is no OpaqueFunction's, which is given the context."""
    code = getattr(value, "__code__", None)
    return code is not None and code.co_argcount == 0 and not code.co_flags & (_MORE_ARGUMENTS | _COROUTINE)


def answering(source: str, value: Any) -> str | None:
    """Return a function of an event that returns what stands in place of one."""
    return f"lambda event: {source}" if actions(source, value) or isinstance(value, list | tuple) else None


def matching(source: str, value: Any) -> str | None:
    """Return the predicate that holds for an action."""
    return f"matches_action({source})" if actions(source, value) else None


def signalled(source: str, value: Any) -> str | None:  # noqa: ARG001 - as the others
    """Return the signal that is called by its number, or without its first letters."""
    if isinstance(value, int):
        return f"signal.{Signals(value).name}" if value in set(Signals) else None
    name = f"SIG{str(value).upper().removeprefix('SIG')}"
    return repr(name) if name in Signals.__members__ else None


def transition(source: str, value: Any) -> str | None:  # noqa: ARG001 - as the others
    """Return the constant of a transition that is called by its name."""
    if not isinstance(value, str):
        return None
    name = value.upper().removeprefix("TRANSITION_")
    return f"lifecycle_msgs.msg.Transition.TRANSITION_{name}" if name in _TRANSITIONS else None


def named_file(source: str, value: Any) -> str | None:
    """Return the dictionary of a parameter that is written as a pair."""
    is_pair = isinstance(value, tuple) and len(value) == _TWO and isinstance(value[0], str)
    is_literal = source[:1] + source[-1:] == "()"
    return f"{{{value[0]!r}: {value[1]!r}}}" if is_pair and is_literal else None


def uncalled(source: str, value: Any) -> str | None:
    """Return the call of a function that stands in place of what it makes."""
    return f"{source}()" if callable(value) else None


def handed_over(source: str, value: Any) -> str | None:  # noqa: ARG001 - as the others
    """Return a function that was called in place of being handed over."""
    called = _CALLED.fullmatch(source)
    return None if called is None else called[1]


def type_called(source: str, value: Any) -> str | None:  # noqa: ARG001 - as the others
    """Return the type of Python that the name of one was meant to be."""
    return _TYPES.get(str(value).lower())
