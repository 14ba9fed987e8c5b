"""Calls whose arguments are alike but for texts, numbers and objects: code that takes such a call apart at once.

Launch files make hundreds of nodes that differ in little else. What `plain_texts.read` finds out about one of them,
item by item, is the same for all that have keywords, lists and names of parameters in common. Of one of these the
code is written that looks whether another call is of the same form, takes from it what may differ, and makes the fields
of its model. Whatever is not alike is left to `read`, which says the same of every call.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, TypeAlias

from orchestra.compat.launch.substitutions.launch_configuration import PERFORM, LaunchConfiguration
from orchestra.compat.launch_ros.call_code import Code, targets
from orchestra.compat.launch_ros.parameter_descriptions import ParameterFile
from orchestra.compat.launch_ros.plain_parameters import NO_PARAMETER, SCALARS, entries, file_of, value_of
from orchestra.compat.launch_ros.plain_texts import (
    UnusualError,
    composed,
    copied,
    entity,
    left,
    plain_text,
    standing_at,
)
from orchestra.compat.place import argument
from orchestra.description.parts import Param, Remap
from orchestra.description.text import matched_words, new_constant

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from orchestra.compat.launch_ros.call_code import Form
    from orchestra.compat.launch_ros.plain_texts import Readers
    from orchestra.compat.place import Way
    from orchestra.description.text import Template

    _Path: TypeAlias = tuple[Way, ...]
    # What is left of an argument, and the expression that makes what it is to the model.
    _Read: TypeAlias = tuple[Any, str]


def shape(given: Any) -> Any:
    """Return what two calls have in common that are of one form, as far as one look tells."""
    kind = type(given)
    if kind is dict:
        return kind, *given, *map(shape, given.values())
    if kind in _SERIES:
        return kind, *map(shape, given)
    return kind if kind is str or kind is LaunchConfiguration else None


def form_of(
    given: dict[str, Any],
    readers: Readers,
    series: Mapping[str, tuple[str, str, Any]],
    unwritten: dict[str, Any],
) -> Form:
    """Return the form of a call, which is one that `plain_texts.read` has read by these readers.

    `series` tells for lists by what they are read, into which field, and what an empty one is.
    """
    return _Reader(unwritten).form(given, readers, series)


class _Reader:
    """Reads the arguments of a call, and writes what reads those of others."""

    def __init__(self, unwritten: dict[str, Any]) -> None:
        self._code = Code(_NAMES | {"nothing": unwritten})

    def form(
        self, given: dict[str, Any], readers: Readers, series: Mapping[str, tuple[str, str, Any]]
    ) -> Form:
        """Return the form of a call."""
        fields: list[str] = []
        skeleton: dict[str, Any] = {}
        names = self._code.new(len(given))
        for var, (name, value) in zip(names, given.items(), strict=True):
            reader = readers[name]
            if value is None:
                self._code.exactly(0, var, type(None))
                skeleton[name] = None
            elif name in series:
                how, field, empty = series[name]
                read: Callable[..., _Read] = getattr(self, how)
                skeleton[name], made = read(var, value, name)
                fields.append(f"{field!r}: {made if value else self._code.constant(empty)}")
            elif isinstance(reader, str):
                skeleton[name], made = self._text(0, var, value, (name,))
                fields.append(f"{reader!r}: {made}")
            else:
                skeleton[name] = self._code.leaf(var)
                if reader is not left:
                    self._read_into(var, name, reader, fields)
        first = f"{targets(names)} = given.values()" if names else "pass"
        return self._code.compiled(first, fields, skeleton)

    def params(self, var: str, value: list[Any], name: str) -> _Read:
        """Read a list of dictionaries and files."""
        skeleton, made = [], []
        for index, (item_var, item) in enumerate(self._code.items(0, var, value)):
            path = (name, index)
            if type(item) is dict:
                own, part = self._entries(item_var, item, path)
            elif type(item) is ParameterFile:
                self._code.exactly(1, item_var, ParameterFile)
                part = self._code.new(1)[0]
                self._code.others.append(f"{part} = file_of({item_var})")
                self._code.leaf(part)
                own = self._code.leaf(item_var)
            else:
                own, file = self._text(1, item_var, item, path)
                part = _param({"from_": file}, f"standing_at(call, {self._code.constant(path)})")
            skeleton.append(own)
            made.append(part)
        return skeleton, f"({''.join(f'{item}, ' for item in made if item)})"

    def remaps(self, var: str, value: list[Any], name: str) -> _Read:
        """Read a list of pairs."""
        skeleton, made = [], []
        beside = self._code.at((name,)) if value else ""
        for index, (rule_var, rule) in enumerate(self._code.items(0, var, value)):
            sides = [
                self._text(2, side_var, side, (name, index, number))
                for number, (side_var, side) in enumerate(self._code.items(1, rule_var, rule))
            ]
            skeleton.append(tuple([side for side, _ in sides]))
            (_, from_), (_, to) = sides
            made.append(f"entity(Remap, {{'from_': {from_}, 'to': {to}}}, {beside})")
        return skeleton, f"({''.join(f'{item}, ' for item in made)})"

    def words(self, var: str, value: list[Any], name: str) -> _Read:
        """Read a list of texts."""
        read = [
            self._text(1, item_var, item, (name, index))
            for index, (item_var, item) in enumerate(self._code.items(0, var, value))
        ]
        return [item for item, _ in read], f"({''.join(f'{made}, ' for _, made in read)})"

    def _entries(self, var: str, items: dict[Any, Any], path: _Path) -> _Read:
        """Read a dictionary of parameters: those in it where these are names and values alone."""
        if not all(type(key) is str and "$" not in key and "\\" not in key for key in items) or any(
            type(value) is dict for value in items.values()
        ):
            self._code.exactly(1, var, dict)
            made = self._code.new(1)[0]
            self._code.others += [
                f"{made} = []",
                f"{var} = entries({var}, around, call, {self._code.constant(path)}, {made})",
            ]
            self._code.leaf(made)
            return self._code.leaf(var), f"*{made}"
        self._code.exactly(1, var, dict)
        level = self._code.level(1)
        level.opened.append(f"if [*{var}] != {self._code.constant([*items])}: return None")
        names = self._code.new(len(items))
        if names:
            level.opened.append(f"{targets(names)} = {var}.values()")
        inner = self._code.level(2)
        inner.exact.append(f"*{var}")
        inner.types += [str] * len(items)
        beside = self._code.at(path) if items else ""
        skeleton, made_of = {}, []
        for item_var, (key, value) in zip(names, items.items(), strict=True):
            skeleton[key], made = self._value(2, item_var, value, (*path, key))
            called = f"words({self._code.constant(key)}, False, call, {self._code.constant(path)})"
            made_of.append(_param({"name": called, "value": made}, beside))
        return skeleton, ", ".join(made_of)

    def _value(self, level: int, var: str, value: Any, path: _Path) -> _Read:
        """Read the value of a parameter."""
        at = self._code.constant(path)
        if type(value) in SCALARS:
            self._code.level(level).scalars.append(var)
            return self._code.leaf(var), f"constant({var}, argument(place, {at}))"
        if type(value) is LaunchConfiguration or _is_mixed(value):
            return self._text(level, var, value, path)
        made = self._code.new(1)[0]
        self._code.others.append(f"{made}, {var} = value_of({var}, call, {at})")
        self._code.leaf(made)
        return self._code.leaf(var), made

    def _text(self, level: int, var: str, value: Any, path: _Path) -> _Read:
        """Read a text, a substitution, or several of both."""
        kind = type(value)
        if kind is str and "$" not in value and "\\" not in value:
            self._code.exactly(level, var, str)
            self._code.texts.append(var)
            return self._code.leaf(var), f"words({var}, False, call, {self._code.constant(path)})"
        if kind is LaunchConfiguration and known(value) is not None:
            return self._code.leaf(var), self._variable(level, var)
        if _is_mixed(value):
            return self._mixed(level, var, value, path)
        made = self._code.new(1)[0]
        self._code.others += [
            f"{made} = plain_text({var}, call, {self._code.constant(path)})",
            f"{var} = copied({var})",
        ]
        self._code.leaf(made)
        return self._code.leaf(var), made

    def _mixed(self, level: int, var: str, value: Sequence[Any], path: _Path) -> _Read:
        """Read several texts and variables as one text."""
        skeleton, items = [], self._code.items(level, var, value)
        for item_var, item in items:
            skeleton.append(self._code.leaf(item_var))
            self._code.exactly(level + 1, item_var, type(item))
            if type(item) is str:
                self._code.texts.append(item_var)
                self._code.needed.append(item_var)
        made = self._code.new(1)[0]
        given = "".join(f"{item_var}, " for item_var, _ in items)
        self._code.others.append(f"{made} = composed(({given}), call, {self._code.constant(path)})")
        self._code.leaf(made)
        return tuple(skeleton) if type(value) is tuple else skeleton, made

    def _variable(self, level: int, var: str) -> str:
        """Return what is the text that a variable is."""
        self._code.exactly(level, var, LaunchConfiguration)
        made = self._code.new(1)[0]
        self._code.variables.append(f"{made} = {var}._sure or sure({var})")
        self._code.leaf(made)
        return made

    def _read_into(self, var: str, name: str, reader: Any, fields: list[str]) -> None:
        """Have a keyword read as `read` does."""
        if "**more" not in fields:
            fields.append("**more")
            self._code.others.append("more, kept = {}, given.copy()")
            self._code.leaf("more")
        self._code.others += [
            f"{self._code.constant(reader)}({name!r}, {var}, call, more, kept)",
            f"{var} = kept[{name!r}]",
        ]


def known(variable: LaunchConfiguration) -> Template | None:
    """Return the text that a variable alone is, None where a closer look has to tell."""
    return variable._sure or (None if variable._whole() is None else variable._sure)


def _sure(variable: LaunchConfiguration) -> Template:
    found = known(variable)
    if found is None:
        raise UnusualError
    return found


def _is_mixed(value: Any) -> bool:
    """Return whether something is several texts and variables with nothing to look at in them."""
    kinds = set(map(type, value)) if type(value) in _SERIES else ()
    if (
        LaunchConfiguration not in kinds
        or not {str, LaunchConfiguration}.issuperset(kinds)
        or len(value) < _SEVERAL
    ):
        return False
    return all(
        (item and "$" not in item and "\\" not in item) if type(item) is str else known(item) is not None
        for item in value
    )


def _param(written: dict[str, str], beside: str) -> str:
    """Return what makes a parameter of these expressions."""
    fields = ", ".join(f"{name!r}: {written.get(name, repr(value))}" for name, value in NO_PARAMETER.items())
    return f"entity(Param, {{{fields}}}, {beside})"


_SERIES: Final = frozenset({list, tuple})
_SEVERAL: Final = 2
_NAMES: Final[dict[str, Any]] = {
    "LaunchConfiguration": LaunchConfiguration,
    "Param": Param,
    "Remap": Remap,
    "argument": argument,
    "around": ((), "", ""),
    "composed": composed,
    "constant": new_constant,
    "copied": copied,
    "entity": entity,
    "entries": entries,
    "file_of": file_of,
    "perform": PERFORM,
    "plain_text": plain_text,
    "scalars": SCALARS,
    "standing_at": standing_at,
    "sure": _sure,
    "unusual": (KeyError, UnusualError, ValueError),
    "value_of": value_of,
    "words": matched_words,
}
