"""Parameters of the usual kinds: dictionaries of values and of dictionaries, and files; and remappings."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.launch_ros.parameter_descriptions import ParameterFile
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
from orchestra.description.parts import Param, Remap
from orchestra.description.text import matched_words, new_constant, new_template, new_words
from orchestra.description.written import escaped

if TYPE_CHECKING:
    from orchestra.compat.launch_ros.plain_texts import Reader
    from orchestra.compat.place import Way
    from orchestra.description.text import Part


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
                file = plain_text(item, call, path)
                made.append(_param({"from_": file}, standing_at(call, path)))
                own.append(copied(item))
        fields[field] = tuple(made)
        kept[name] = own

    return reader


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


def remaps(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
    """Read a list of rules, of which each has two sides."""
    if type(value) is not list:
        raise UnusualError
    beside = standing_at(call, (name,))
    made, own = [], []
    for index, rule in enumerate(value):
        if type(rule) is not tuple or len(rule) != _SIDES:
            raise UnusualError
        source, target = rule
        if type(source) is str and "$" not in source and "\\" not in source:  # as `plain_text` does, at once
            from_ = matched_words(source, False, call, (name, index, 0))  # type: ignore[arg-type] # its groups are paths
        else:
            from_ = plain_text(source, call, (name, index, 0))
        to = plain_text(target, call, (name, index, 1))
        made.append(entity(Remap, {"from_": from_, "to": to}, beside))
        own.append(rule if type(source) is type(target) is str else copied(rule))
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
    before, written, known = around
    own, span, beside = {}, call.span(path), standing_at(call, path)
    for key, value in items.items():
        if type(key) is not str:
            raise UnusualError
        name = known + key
        if type(value) is dict:
            if key == "ros__parameters":
                raise UnusualError
            parts = (*before, new_words(key, span)) if key else before
            inner = ((*parts, new_words(".", span)), f"{written}{escaped(key)}.", f"{name}.")
            own[key] = entries(value, inner, call, path, made)
            continue
        if before or "$" in key or "\\" in key:
            parts = (*before, new_words(key, span)) if key else before
            called = new_template(parts, written + escaped(key), span)
        else:
            called = matched_words(key, False, call, path)  # type: ignore[arg-type] # its groups are paths
        read, own[key] = value_of(value, call, (*path, name))
        made.append(_param({"name": called, "value": read}, beside))
    return own


def _param(fields: dict[str, Any], beside: dict[str, Any]) -> Param:
    made: Param = entity(Param, NO_PARAMETER | fields, beside)
    return made


def value_of(value: Any, call: Arguments, path: tuple[Way, ...]) -> tuple[Any, Any]:
    """Return what the value of a parameter is to the model, and a copy of it."""
    kind = type(value)
    if kind in SCALARS:
        return new_constant(value, argument(call.place, path)), value
    if kind is not list and kind is not tuple:
        return whole_text(value), value
    kinds = set(map(type, value))
    if kinds <= SCALARS:
        if len(kinds) > 1 and kinds not in ({int, float}, {bool, int}):
            raise UnusualError
        items = map(float, value) if kinds == {int, float} else value
        return new_constant(tuple(items), argument(call.place, path)), kind(value)
    return composed(value, call, path), kind(value)


_SIDES: Final = 2
_FILE: Final = ("param_file",)
SCALARS: Final = frozenset({str, bool, int, float})
NO_PARAMETER: Final = Param._unwritten()
