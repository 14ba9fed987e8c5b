"""What JSON Schemas and models of pydantic have in common: a tree that their library validates, built along a schema.

What the library lets pass and a node would not take is told as uncertain: a whole number written as a double where an
integer is declared, or the other way round, and names that the schema neither declares nor refuses.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

from orchestra.dataclass import dataclass
from orchestra.declared.common import is_common
from orchestra.declared.judging import of_every_node, wrong_type
from orchestra.declared.misnamed import misnamed
from orchestra.declared.model import Fault, Parameter
from orchestra.declared.plain_schema import ROS_TYPE
from orchestra.declared.shape import Level, Place, place, ros_types, tree
from orchestra.declared.typing_of_values import is_taken
from orchestra.values import ParameterValue

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

# A schema that holds itself has levels without end.
_MOST_LEVELS: Final = 200


@dataclass(frozen=True, slots=True)
class Structured:
    """The values of a node as a tree; `names` are the parameters by their way in it."""

    values: Mapping[str, ParameterValue]
    places: Mapping[str, Place]
    root: Level

    @property
    def tree(self) -> dict[str, Any]:
        """The values as the library validates them."""
        return tree(self.values, self.places)

    def named(self, way: tuple[str | int, ...]) -> tuple[str, int | None]:
        """Return the parameter, or group, at a way in the tree, and the index of an item of a list."""
        index = next((step for step in way if isinstance(step, int)), None)
        steps = tuple(str(step) for step in way[: way.index(index) if index is not None else None])
        return ".".join(steps), index


def structured(values: Mapping[str, ParameterValue], root: Level) -> Structured:
    """Return the values that a schema is about: those that every node has only where it says something of them."""
    places = {name: place(name, root) for name in values}
    own = {name: value for name, value in values.items() if places[name].known or not is_common(name)}
    return Structured(own, {name: places[name] for name in own}, root)


def common_faults(values: Mapping[str, ParameterValue], found: Structured) -> Iterator[Fault]:
    """Yield what is wrong with values of parameters that every node has, and of which the schema says nothing."""
    return of_every_node({name: value for name, value in values.items() if name not in found.values})


def unlike(found: Structured, told: set[str]) -> Iterator[Fault]:
    """Yield values whose type no node would take for what is declared, but for those that have been told of."""
    for name, value in found.values.items():
        said = found.places[name].said
        if said is None or name in told:
            continue
        types, beside = ros_types(said)
        exact = Parameter(name, types, () if set(types) & set(beside) else beside)
        certain = any(ROS_TYPE in schema for schema, _ in said.schemas)
        taken = is_taken(exact, value)
        if taken is not True:
            yield wrong_type(exact, name, value, certain=certain and taken is False)


@lru_cache(maxsize=16)  # a thousand nodes have the same schema
def known_names(root: Level) -> tuple[str, ...]:
    """Return the dotted names of all parameters that a schema names; of one that holds itself, the outer ones."""
    names: list[str] = []
    waiting = deque([("", root)])
    for _ in range(_MOST_LEVELS):
        if not waiting:
            break
        above, at = waiting.popleft()
        for name in at.names:
            inner = at.below(name)
            if inner is not None and inner.is_object:
                waiting.append((f"{above}{name}.", inner))
            else:
                names.append(f"{above}{name}")
    return tuple(names)


def undeclared(name: str, found: Structured, *, certain: bool) -> Fault:
    """Return that a name is declared nowhere, with the one that is meant."""
    place_of_it = found.places.get(name)
    beside = () if place_of_it is None else place_of_it.beside
    fault = misnamed(name, dict.fromkeys([*known_names(found.root), *beside]))
    return Fault("undeclared", fault.name, fault.told, fault.meant, None, certain)


def unsaid(found: Structured, told: set[str]) -> Iterator[Fault]:
    """Yield names of which the schema says neither that they are declared nor that there may be others."""
    if found.root.open:
        return
    for name in found.values:
        if not found.places[name].known and told.isdisjoint(_groups(name)):
            yield undeclared(name, found, certain=False)


def _groups(name: str) -> Iterator[str]:
    """Yield a name and those of the groups that it is within."""
    while name:
        yield name
        name = name.rpartition(".")[0]


def faults_with(
    values: Mapping[str, ParameterValue],
    root: Level,
    said: Callable[[Structured], Iterable[Fault]],
    *,
    closed: bool = True,
) -> Iterator[Fault]:
    """Yield what a library says of values, and what it passes over and a node would not, without what only follows.

    Without `closed` there may be other names.
    """
    return _settled(_every(values, structured(values, root), said, closed=closed))


def _every(
    values: Mapping[str, ParameterValue],
    found: Structured,
    said: Callable[[Structured], Iterable[Fault]],
    *,
    closed: bool,
) -> Iterator[Fault]:
    told: set[str] = set()
    for faults in (said(found), unsaid(found, told) if closed else ()):
        for fault in faults:
            told.add(fault.name)
            yield fault
    yield from unlike(found, told)
    yield from common_faults(values, found)


def _settled(faults: Iterable[Fault]) -> Iterator[Fault]:
    """Yield faults without those that follow: what is said to be missing stands there under another name."""
    every = list(faults)
    meant = {fault.meant for fault in every if fault.kind == "undeclared"}
    for fault in every:
        if fault.kind != "missing" or meant.isdisjoint(_groups(fault.name)):
            yield fault
