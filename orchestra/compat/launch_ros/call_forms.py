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
from orchestra.compat.launch_ros.call_texts import Read, Texts, is_mixed, is_plain, known, sure
from orchestra.compat.launch_ros.parameter_descriptions import ParameterFile, ParameterValue
from orchestra.compat.launch_ros.plain_parameters import (
    SCALARS,
    entries,
    file_at,
    file_of,
    held_of,
    parameter_of,
    rule_of,
    typed_of,
    value_of,
)
from orchestra.compat.launch_ros.plain_texts import (
    UnusualError,
    copied,
    left,
    mixed,
    plain_text,
)
from orchestra.description.parts import LateParam, LateRemap, late
from orchestra.description.text import matched_words

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from orchestra.compat.launch_ros.call_code import Form
    from orchestra.compat.launch_ros.plain_texts import Readers
    from orchestra.compat.place import Way

    _Path: TypeAlias = tuple[Way, ...]


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


class _Reader(Texts):
    """Reads the arguments of a call, and writes what reads those of others."""

    def __init__(self, unwritten: dict[str, Any]) -> None:
        super().__init__(Code(_NAMES | {"nothing": unwritten}))

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
                read: Callable[..., Read] = getattr(self, how)
                skeleton[name], made = read(var, value, name)
                fields.append(f"fields[{field!r}] = {made if value else self._code.constant(empty)}")
            elif isinstance(reader, str):
                skeleton[name], made = self.text(0, var, value, (name,))
                fields.append(f"fields[{reader!r}] = {made}")
            else:
                skeleton[name] = self._code.leaf(var)
                if reader is not left:
                    self._read_into(var, name, reader, fields)
        first = f"{targets(names)} = given.values()" if names else "pass"
        return self._code.compiled(first, fields, skeleton)

    def params(self, var: str, value: list[Any], name: str) -> Read:
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
                own, file = self.text(1, item_var, item, path)
                part = f"file_at({file}, call, {self._code.constant(path)})"
            skeleton.append(own)
            made.append(part)
        return skeleton, f"({''.join(f'{item}, ' for item in made if item)})"

    def remaps(self, var: str, value: list[Any], name: str) -> Read:
        """Read a list of pairs."""
        skeleton, made = [], []
        for index, (rule_var, rule) in enumerate(self._code.items(0, var, value)):
            sides = [
                (self.word(2, side_var), side_var)
                if is_plain(side)
                else self.text(2, side_var, side, (name, index, number))
                for number, (side_var, side) in enumerate(self._code.items(1, rule_var, rule))
            ]
            skeleton.append(tuple([side for side, _ in sides]))
            texts, at = ", ".join([text for _, text in sides]), self._code.constant((name, index))
            made.append(f"late(LateRemap, ({texts}, rule_of, call, {at}))")
        return skeleton, f"({''.join(f'{item}, ' for item in made)})"

    def words(self, var: str, value: list[Any], name: str) -> Read:
        """Read a list of texts."""
        read = [
            self.text(1, item_var, item, (name, index))
            for index, (item_var, item) in enumerate(self._code.items(0, var, value))
        ]
        return [item for item, _ in read], f"({''.join(f'{made}, ' for _, made in read)})"

    def _entries(self, var: str, items: dict[Any, Any], path: _Path) -> Read:
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
        skeleton, made_of = {}, []
        for item_var, key, value in self._code.entries(1, var, items):
            name, at = self._code.constant(key), self._code.constant(path)
            if type(value) is ParameterValue:
                self._code.exactly(2, item_var, ParameterValue)
                made = self._code.new(1)[0]
                self._code.others.append(f"{made} = typed_of({item_var}, {name}, around, call, {at})")
                self._code.leaf(made)
                skeleton[key] = self._code.leaf(item_var)
                made_of.append(made)
                continue
            skeleton[key], made = self._held(2, item_var, value) or self._value(
                2, item_var, value, (*path, key)
            )
            made_of.append(f"late(LateParam, ({name}, {made}, parameter_of, call, {at}, around))")
        return skeleton, ", ".join(made_of)

    def _held(self, level: int, var: str, value: Any) -> Read | None:
        """Read a value that is known without a visit; None for any other."""
        if type(value) in SCALARS:
            self._code.scalar(level, var)
            return self._code.leaf(var), var
        if held_of(value) is None:
            return None
        made = self._code.new(1)[0]
        self._code.others += [
            f"{made} = held_of({var})",
            f"if {made} is None: return None",
            f"{var} = copied({var})",
        ]
        self._code.leaf(made)
        return self._code.leaf(var), made

    def _value(self, level: int, var: str, value: Any, path: _Path) -> Read:
        """Read the value of a parameter that takes a visit to know."""
        if (type(value) is LaunchConfiguration and known(value) is not None) or is_mixed(value):
            return self.text(level, var, value, path)
        made = self._code.new(1)[0]
        self._code.others += [
            f"if held_of({var}) is not None: return None",
            f"{made} = value_of({var}, call, {self._code.constant(path)})",
            f"{var} = copied({var})",
        ]
        self._code.leaf(made)
        return self._code.leaf(var), made

    def _read_into(self, var: str, name: str, reader: Any, fields: list[str]) -> None:
        """Have a keyword read as `read` does."""
        if "fields |= more" not in fields:
            fields.append("fields |= more")
            self._code.others.append("more, kept = {}, given.copy()")
            self._code.leaf("more")
        self._code.others += [
            f"{self._code.constant(reader)}({name!r}, {var}, call, more, kept)",
            f"{var} = kept[{name!r}]",
        ]


_SERIES: Final = frozenset({list, tuple})
_SEVERAL: Final = 2
_NAMES: Final[dict[str, Any]] = {
    "LaunchConfiguration": LaunchConfiguration,
    "LateParam": LateParam,
    "LateRemap": LateRemap,
    "around": ((), "", ""),
    "copied": copied,
    "entries": entries,
    "file_at": file_at,
    "file_of": file_of,
    "held_of": held_of,
    "late": late,
    "mixed": mixed,
    "parameter_of": parameter_of,
    "perform": PERFORM,
    "plain_text": plain_text,
    "rule_of": rule_of,
    "scalars": SCALARS,
    "sure": sure,
    "typed_of": typed_of,
    "unusual": (KeyError, UnusualError, ValueError),
    "value_of": value_of,
    "words": matched_words,
}
