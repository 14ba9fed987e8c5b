"""The type of a parameter value that is written as text in a launch file.

Upstream reads it with PyYAML (YAML 1.1), writes what it got into a file without quotes where PyYAML needs none, and
rcl types that once more: `1e3` is text to PyYAML and a double in the node. Both steps are followed here for what is
written plain; what is quoted or given a type stays what it says (upstream re-types that as well, by mistake).
Source: `launch.utilities.type_utils` and `launch_ros.utilities` of Jazzy, measured; `tests/data/rcl-probes.jsonl`.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

from orchestra.description.source import shortened
from orchestra.nearest import nearest
from orchestra.resolve.rcl import scalars as rcl
from orchestra.resolve.yaml_scalars import QUOTE, Plain, by_core, by_pyyaml, read_scalars, value_alike

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.resolve.yaml_scalars import Construct
    from orchestra.values import ParameterValue, Scalar

TYPES: Final = (
    *("str", "bool", "int", "float"),
    *("list_of_str", "list_of_bool", "list_of_int", "list_of_float"),
    "yaml",
)

_INTEGERS = range(-(2**63), 2**63)
_WORDS: Final[dict[type, str]] = {bool: "boolean", int: "integer", float: "float", str: "text"}
_LONGEST_KEPT: Final = 1_000  # characters: what is longer is hardly ever read twice
_KINDS: Final[dict[str, type]] = {"str": str, "bool": bool, "int": int, "float": float}


def upstream_value(text: str) -> ParameterValue:
    """Return the value that a node gets upstream for a text without a type.

    Raises `ValueError` with the reason where it can have no type: null, a date, a mapping, an empty, nested or mixed
    list, an integer beyond 64 bits, what is not YAML.
    """
    return _value(text, by_pyyaml)


def core_value(text: str) -> ParameterValue:
    """Return the value of a text in the core schema of YAML 1.2. Raises `ValueError` like `upstream_value`."""
    return _value(text, by_core)


def differs(text: str) -> str | None:
    """Return a sentence for a warning where YAML 1.2 reads a text as something else than upstream; None if not.

    A text that upstream cannot read is no surprise but an error: None too.
    """
    if value_alike(text) is not None:
        return None
    try:
        upstream = upstream_value(text)
    except ValueError:
        return None
    try:
        core = core_value(text)
    except ValueError:
        return f"'{text}' is read as {described(upstream)}, as ROS 2 does; YAML 1.2 cannot read it so"
    if _same(upstream, core):
        return None
    return f"'{text}' is read as {described(upstream)}, as ROS 2 does; YAML 1.2 reads {described(core)}"


def coerced(text: str, type_word: str) -> ParameterValue:
    """Return the value of a text that was given a type, one of `TYPES`.

    Raises `ValueError` with the reason. `int` and `float` are Python's conversions, as upstream's; `bool` takes `1`,
    `0` and what YAML 1.1 reads as a boolean; integers are welcome in a list of floats.
    """
    if type_word == "yaml":
        return upstream_value(text)
    if type_word.startswith("list_of_") and type_word in TYPES:
        return _list_of(text, type_word)
    if type_word in _KINDS:
        return _sayable(_converted(text, _KINDS[type_word]))
    near = nearest(type_word, TYPES)
    raise ValueError(
        f"'{type_word}' is no type{f', did you mean {near!r}?' if near else ': ' + ', '.join(TYPES)}"
    )


def unified(values: Sequence[ParameterValue], texts: Sequence[str] = ()) -> ParameterValue:
    """Return one list of one type: integers beside floats become floats, as in a list in Python.

    `texts` are what the values were read from: where YAML reads all of them as texts, they are a list of texts, though
    rcl alone would read some (as `y`) otherwise. Raises `ValueError` with the reason: empty, nested or mixed.
    """
    kinds = {type(value) for value in values}
    if kinds == {int, float}:
        return tuple(float(value) for value in values if isinstance(value, int | float))
    if len(kinds) > 1 and len(texts) == len(values) and all(map(_is_text, texts)):
        return tuple(texts)
    return _uniform(values)


def checked(value: ParameterValue, type_word: str | None = None) -> ParameterValue:
    """Return a value that has its type already as a node can have it; it must be of the type that is asked for.

    A list in Python may have booleans beside integers, which to Python are integers too (launch_ros,
    `normalize_parameters`). Raises `ValueError` with the reason.
    """
    if not isinstance(value, tuple | list):
        found: ParameterValue = _sayable(value)
    elif {type(item) for item in value} == {bool, int}:
        found = tuple(int(item) for item in value)
    else:
        found = unified([_sayable(item) for item in value])
    if type_word not in (None, "yaml") and _type_word(found) != type_word:
        raise ValueError(f"{described(found)} is not of the type {type_word}")
    return found


def number_held(value: ParameterValue) -> ParameterValue | None:
    """Return a number or a truth value that rcl can hold, None for anything else: `checked` has more to look at."""
    held = type(value) is float or type(value) is bool or (type(value) is int and value in _INTEGERS)
    return value if held else None


def flow(value: ParameterValue) -> str:
    """Return the text of a value for `$(param)`, as Python writes it; a list so that it can be read again."""
    return f"[{', '.join(map(_shown, value))}]" if isinstance(value, tuple) else str(value)


@lru_cache(maxsize=64)  # as many lists say the same
def _is_text(text: str) -> bool:
    return not text.strip() or isinstance(read_scalars(text, by_pyyaml), str)


def _value(text: str, construct: Construct) -> ParameterValue:
    alike = value_alike(text)
    if alike is not None:
        return alike
    return (_parsed if len(text) > _LONGEST_KEPT else _parsed_once)(text, construct)


def _parsed(text: str, construct: Construct) -> ParameterValue:
    if not text.strip():
        return text
    read = read_scalars(text, construct)
    if not isinstance(read, list):
        return _retyped(read)
    retyped = [_retyped(item) for item in read]
    if all(isinstance(item, str) for item in read) and len({type(item) for item in retyped}) > 1:
        return tuple(map(str, read))  # `[a, y]`: rcl would refuse the list for the sake of the `y`
    return _uniform(retyped)


_parsed_once: Final = lru_cache(maxsize=512)(_parsed)


def _retyped(value: Any) -> Scalar:  # noqa: ANN401 - whatever the text says
    """Give a plain text the type that rcl gives it in the file; check that rcl can have the value at all."""
    return _sayable(rcl.typed(str(value)) if isinstance(value, Plain) else value)


def _text(value: Any) -> Any:  # noqa: ANN401 - whatever the text says
    return str(value) if isinstance(value, Plain) else value


def _list_of(text: str, type_word: str) -> ParameterValue:
    kind = _KINDS[type_word.removeprefix("list_of_")]
    read = read_scalars(text, by_pyyaml)
    if not isinstance(read, list):
        raise ValueError(f"'{shortened(text)}' is no list")  # noqa: TRY004
    items = [_retyped(item) if kind is float else _sayable(_text(item)) for item in read]
    if kind is float:
        items = [float(item) if type(item) is int else item for item in items]
    for item in items:
        if type(item) is not kind:
            raise ValueError(f"{described(item)} does not fit into a {type_word}")
    return _uniform(items)


def _converted(text: str, kind: type) -> Scalar:
    if kind is str:
        return text
    if kind is bool:
        value = {"1": True, "0": False}.get(text.strip())
        read = read_scalars(text, by_pyyaml) if value is None and text.strip() else value
        if isinstance(read, bool):
            return read
    else:
        try:
            return int(text) if kind is int else _float(text)
        except ValueError:
            pass
    raise ValueError(f"'{shortened(text)}' is no {_WORDS[kind]}")


def _float(text: str) -> float:
    """Read a float as Python does, and the words that only YAML has for what is no number: `.inf`, `.nan`."""
    read = rcl.typed(text.strip())
    return read if isinstance(read, float) else float(text)


def _uniform(values: Sequence[Any]) -> ParameterValue:
    if not values:
        raise ValueError("an empty list has no type, so it cannot be a parameter")
    kinds = list(dict.fromkeys(type(value) for value in values))
    if tuple in kinds:
        raise ValueError("a list of lists cannot be a parameter")
    if len(kinds) > 1:
        names = " and ".join(_shown(next(v for v in values if type(v) is kind)) for kind in kinds[:2])
        raise ValueError(f"a list must hold values of one type, not {names}")
    return tuple(values)


def _sayable(value: Any) -> Scalar:  # noqa: ANN401 - whatever PyYAML made
    """Return a value that rcl can hold. Raises `ValueError` for any other."""
    if value is None:
        raise ValueError(f"null cannot be a parameter: {QUOTE}")
    if type(value) not in _WORDS:
        word = {bytes: "binary data"}.get(type(value), "a date")
        raise ValueError(f"{word} cannot be a parameter: {QUOTE}")
    if isinstance(value, int) and value not in _INTEGERS:
        raise ValueError(f"{value} does not fit into 64 bits")
    if isinstance(value, str) and ("\0" in value or re.search("[\ud800-\udfff]", value)):
        raise ValueError("a text with NUL or a lone surrogate cannot be a parameter")
    checked: Scalar = value
    return checked


def _type_word(value: ParameterValue) -> str:
    return f"list_of_{type(value[0]).__name__}" if isinstance(value, tuple) else type(value).__name__


def _same(one: ParameterValue, other: ParameterValue) -> bool:
    return repr(one) == repr(other)


def described(value: ParameterValue) -> str:
    """Return a value in words, for messages."""
    if isinstance(value, tuple):
        return f"the list [{', '.join(map(_shown, value))}]"
    return f"the {_WORDS[type(value)]} {_shown(value)}"


def _shown(value: Scalar) -> str:
    return str(value).lower() if isinstance(value, bool) else repr(value)
