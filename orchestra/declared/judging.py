"""Values of parameters against their declarations."""

from __future__ import annotations

import re
from itertools import product
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.declared.common import COMMON, common_meant, is_common
from orchestra.declared.misnamed import misnamed
from orchestra.declared.model import Declarations, Fault, Parameter
from orchestra.declared.rules import objections
from orchestra.declared.texts import shown, types_of
from orchestra.declared.typing_of_values import is_taken, rewritten, type_of
from orchestra.fields import field, replace
from orchestra.nearest import is_slip, nearest

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from orchestra.values import ParameterValue

_EMPTY_PARAMETER = Parameter("")
_MOST: Final = 1000  # names that are remembered
# Words of a regular expression, what begins with a backslash in it, and parts of a name.
_WORD: Final = re.compile(r"[A-Za-z]{3,}")
_ESCAPE: Final = re.compile(r"\\.")
_PART: Final = re.compile(r"[A-Za-z]+|[^A-Za-z]+")


@dataclass(frozen=True, slots=True)
class DeclaredParameters:
    """The schema of a node whose parameters are all known."""

    declared: Declarations
    _matching: dict[str, list[Parameter]] = field(default_factory=dict, init=False, repr=False, compare=False)

    def faults(self, values: Mapping[str, ParameterValue]) -> Iterator[Fault]:
        """Yield what is wrong with values by dotted name."""
        known, groups = expanded(self.declared, values)
        meant: set[str] = set()
        for name, value in values.items():
            declared = [known[name]] if name in known else self._by_pattern(name)
            if not declared and name in COMMON:
                declared = [Parameter(name, (COMMON[name],))]
            for parameter in declared:
                yield from value_faults(parameter, name, value)
            if declared:
                continue
            if not is_common(name) and not _is_below(name, groups) and self.declared.undeclared != "allowed":
                fault = misnamed(name, known)
                if fault.name == name:
                    # A slip in a word is nearer than any whole name that is only like it.
                    meant_by = self._meant_by_pattern(name) or common_meant(name)
                    fault = replace(fault, meant=meant_by or fault.meant)
                meant.add(fault.meant or fault.name.rpartition(".")[0])
                yield replace(fault, certain=self.declared.undeclared == "refused")
        for name, parameter in known.items():
            if parameter.required and name not in values and not _is_meant(name, meant):
                yield missing(name, refused=parameter.default is not None)

    def _by_pattern(self, name: str) -> list[Parameter]:
        """Return what patterns declare of a name. Nodes of a kind are given the same names again and again."""
        found = self._matching.get(name)
        if found is None:
            if len(self._matching) >= _MOST:
                self._matching.clear()
            found = [item for pattern, item in self.declared.patterns if re.search(pattern, name)]
            self._matching[name] = found
        return found

    def _meant_by_pattern(self, name: str) -> str | None:
        """Return a name that a pattern takes and this one is a slip for, word by word: `imu0_config`."""
        words = {
            word for pattern, _ in self.declared.patterns for word in _WORD.findall(_ESCAPE.sub(" ", pattern))
        }
        parts = _PART.findall(name)
        for index, part in enumerate(parts):
            near = nearest(part, words)
            meant = "".join([*parts[:index], near or part, *parts[index + 1 :]])
            if near is not None and is_slip(part, near) and self._by_pattern(meant):
                return meant
        return None


def expanded(
    declared: Declarations, values: Mapping[str, ParameterValue]
) -> tuple[dict[str, Parameter], tuple[str, ...]]:
    """Return the parameters by name, and the groups in which anything may be, given the lists that name them.

    Where such a list has no value that is known, anything may be below what it would name.
    """
    known = {item.name: item for item in declared.parameters if not item.keys}
    groups = list(declared.groups)
    for item in declared.parameters:
        if not item.keys:
            continue
        lists = [_names(key, known, values) for key in item.keys]
        if any(names is None for names in lists):
            groups.append(item.name.partition(".{}")[0])
            continue
        for names in product(*(names or () for names in lists)):
            name = item.name.format(*names)
            known.setdefault(name, replace(item, name=name, keys=()))
    return known, tuple(groups)


def _names(
    key: str, known: Mapping[str, Parameter], values: Mapping[str, ParameterValue]
) -> tuple[str, ...] | None:
    """Return the items of the list of texts that names a level, None where they are not known."""
    given = values.get(key, known.get(key, _EMPTY_PARAMETER).default)
    if not isinstance(given, tuple):
        return None
    return tuple(dict.fromkeys(str(item) for item in given))


def value_faults(parameter: Parameter, name: str, value: ParameterValue) -> Iterator[Fault]:
    """Yield what is wrong with one value. One of the wrong type is looked at no further."""
    taken = is_taken(parameter, value)
    if taken is not True:
        yield wrong_type(parameter, name, value, certain=taken is False)
    if taken is False:
        return
    for rule in parameter.rules:
        for objection in objections(rule, value):
            told = f"'{name}' {objection.told}"
            yield Fault("value", name, told, objection.meant, objection.item)


def wrong_type(parameter: Parameter, name: str, value: ParameterValue, *, certain: bool) -> Fault:
    """Return that a value is of a type that a parameter does not take; not `certain` where the schema alone would."""
    kind = type_of(value)
    found = types_of([kind]) if kind is not None else "an empty list"
    refused = "which the node refuses" if certain else "which most nodes refuse"
    told = f"'{name}' is declared as {types_of(parameter.types)}; {shown(value)} is {found}, {refused}"
    return Fault("type", name, told, rewritten(value, parameter.types), certain=certain)


def missing(name: str, *, refused: bool = False) -> Fault:
    """Return that a parameter without a default, or with one that the node itself refuses, has no value."""
    why = "whose default it refuses" if refused else "which has no default"
    return Fault("missing", name, f"the node needs a value for its parameter '{name}', {why}")


def _is_meant(name: str, meant: set[str]) -> bool:
    """Return whether a name is one that a faulty one stands for, or is in a group with such a one."""
    return any(item and (name == item or name.startswith(f"{item}.")) for item in meant)


def _is_below(name: str, groups: tuple[str, ...]) -> bool:
    return any(not group or name == group or name.startswith(f"{group}.") for group in groups)


def of_every_node(values: Mapping[str, ParameterValue]) -> Iterator[Fault]:
    """Yield what is wrong with values of parameters that every node has."""
    for name, kind in COMMON.items():
        if name in values:
            yield from value_faults(Parameter(name, (kind,)), name, values[name])
    for name in values:
        if (meant := common_meant(name)) is not None and meant not in values:
            told = f"'{name}' is not '{meant}', which every node has"
            yield Fault("undeclared", name, told, meant, certain=False)
