"""Parameters of the usual kinds: dictionaries of values and of dictionaries, and files; and remappings."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution
from orchestra.compat.launch_ros.models import typed_fields
from orchestra.compat.launch_ros.parameter_descriptions import ParameterFile, ParameterValue
from orchestra.compat.launch_ros.plain_texts import (
    UnusualError,
    composed,
    copied,
    entity,
    plain_text,
    standing_at,
    whole_text,
)
from orchestra.compat.place import Arguments, argument
from orchestra.compat.refusing import is_lost
from orchestra.description.parts import LateParam, LateRemap, Param, Remap, late
from orchestra.description.text import Template, matched_words, new_constant, new_template, new_words
from orchestra.description.written import escaped

if TYPE_CHECKING:
    from orchestra.compat.launch_ros.plain_texts import Reader
    from orchestra.compat.place import Way
    from orchestra.description.text import Part
    from orchestra.location import Span


def parameters(field: str) -> Reader:
    """Return what reads a list of parameters."""

    def reader(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
        if type(value) is not list:
            raise UnusualError
        made: list[Param] = []
        own: list[Any] = []
        for index, item in enumerate(value):
            path = (name, index)
            if type(item) is dict:
                own.append(entries(item, ((), "", ""), call, path, made))
            elif type(item) is ParameterFile:
                made.append(file_of(item))
                own.append(item)
            else:
                made.append(file_at(plain_text(item, call, path), call, path))
                own.append(copied(item))
        fields[field] = tuple(made)
        kept[name] = own

    return reader


def file_at(file: Template, call: Arguments, path: tuple[Way, ...]) -> Param:
    """Return a parameter file that an argument of a call holds."""
    return _param({"from_": file}, standing_at(call, path))


def file_of(item: ParameterFile) -> Param:
    """Return a parameter file that has its arguments as they were given, at its own place."""
    if item._as_given is None:
        raise UnusualError
    (path,), keywords = item._as_given
    call = Arguments(item._place)
    fields = {"from_": plain_text(path, call, _FILE)}
    if keywords.get("allow_substs"):
        fields["allow_substs"] = plain_text("true", call, _FILE)
    return _param(fields, standing_at(call, _FILE))


def typed_of(
    value: ParameterValue,
    name: str,
    around: tuple[tuple[Part, ...], str, str],
    call: Arguments,
    path: tuple[Way, ...],
) -> Param:
    """Return a parameter of which more is said than its value, if that is one of the types that there are."""
    if is_lost(value) or value.value_type not in _TYPES:
        raise UnusualError
    written = value._written
    for item in written if type(written) is list else ():
        if type(item) is not TextSubstitution:
            whole_text(item)
    called = _called(name, around, call, path)
    return _param({"name": called, **typed_fields(value)}, standing_at(call, path))


def remaps(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
    """Read a list of rules, of which each has two sides."""
    if type(value) is not list:
        raise UnusualError
    made: list[Remap] = []
    own = []
    for index, rule in enumerate(value):
        if type(rule) is not tuple or len(rule) != _SIDES:
            raise UnusualError
        sides = [
            side
            if type(side) is str and "$" not in side and "\\" not in side
            else plain_text(side, call, (name, index, number))
            for number, side in enumerate(rule)
        ]
        made.append(late(LateRemap, (*sides, rule_of, call, (name, index))))
        own.append(copied(rule))
    fields["remap"] = tuple(made)
    kept[name] = own


def entries(
    items: dict[Any, Any],
    around: tuple[tuple[Part, ...], str, str],
    call: Arguments,
    path: tuple[Way, ...],
    made: list[Param],
) -> dict[Any, Any]:
    """Add the parameters of a dictionary, whose names begin with what is around it; return a copy of it."""
    known = around[2]
    own: dict[Any, Any] = {}
    for key, value in items.items():
        if type(key) is not str:
            raise UnusualError
        kind = type(value)
        if kind is dict:
            if key == "ros__parameters":
                raise UnusualError
            before, written, span = _before(key, around, call.span(path)), around[1], call.span(path)
            inner = ((*before, new_words(".", span)), f"{written}{escaped(key)}.", f"{known}{key}.")
            own[key] = entries(value, inner, call, path, made)
            continue
        own[key] = value if kind in SCALARS else copied(value)
        held = value if kind in SCALARS else held_of(value)
        if kind is ParameterValue:
            made.append(typed_of(value, known + key, around, call, path))
            continue
        if held is None:
            held = value_of(value, call, (*path, known + key))
        made.append(late(LateParam, (known + key, held, parameter_of, call, path, around)))
    return own


def _before(key: str, around: tuple[tuple[Part, ...], str, str], span: Span) -> tuple[Part, ...]:
    """Return the words of a name up to the end of a key."""
    return (*around[0], new_words(key, span)) if key else around[0]


def _called(
    name: str, around: tuple[tuple[Part, ...], str, str], call: Arguments, path: tuple[Way, ...]
) -> Template:
    """Return the name of a parameter as a text."""
    if not around[0] and "$" not in name and "\\" not in name:
        return matched_words(name, False, call, path)  # type: ignore[arg-type] # its groups are paths
    span, key = call.span(path), name[len(around[2]) :]
    return new_template(_before(key, around, span), around[1] + escaped(key), span)


def _param(fields: dict[str, Any], beside: dict[str, Any]) -> Param:
    made: Param = entity(Param, _NO_PARAMETER | fields, beside)
    return made


def parameter_of(row: tuple[Any, ...]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the fields of a parameter whose value is known, or is a text, and what is beside them."""
    name, value, _, call, path, around = row
    called = _called(name, around, call, path)
    read = value if isinstance(value, Template) else new_constant(value, argument(call.place, (*path, name)))
    return _NO_PARAMETER | {"name": called, "value": read}, standing_at(call, path)


def rule_of(row: tuple[Any, ...]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the fields of a rule by its sides, and what is beside them."""
    *sides, _, call, path = row
    from_, to = [
        matched_words(side, False, call, (*path, number)) if type(side) is str else side  # type: ignore[arg-type] # its groups are paths
        for number, side in enumerate(sides)
    ]
    return {"from_": from_, "to": to}, standing_at(call, path[:1])


def value_of(value: Any, call: Arguments, path: tuple[Way, ...]) -> Any:
    """Return what the value of a parameter is to the model where that takes a visit to know."""
    kind = type(value)
    return composed(value, call, path) if kind is list or kind is tuple else whole_text(value)


def held_of(value: Any) -> Any:
    """Return a list of scalars as it is to the model; None for what only a visit knows."""
    kind = type(value)
    if kind is not list and kind is not tuple:
        return None
    kinds = set(map(type, value))
    if not kinds <= SCALARS:
        return None
    if len(kinds) <= 1:
        return tuple(value)
    if kinds == {int, float}:
        return tuple(map(float, value))
    if kinds == {bool, int}:
        return tuple(value)
    raise UnusualError


_SIDES: Final = 2
_FILE: Final = ("param_file",)
_TYPES: Final = (None, str, bool, int, float)
SCALARS: Final = frozenset({str, bool, int, float})
_NO_PARAMETER: Final = Param._unwritten()
