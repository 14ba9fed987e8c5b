"""Parameters that nodes of one program are given with values of different types, of which one is refused.

A parameter keeps the type it is declared with: `10` for one that another node of the program has as `10.0`, a number in
quotes. Where the program's parameters are known, they are judged by that (`declared`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.plan.checks.declared import nodes_of, programs_of
from orchestra.plan.written import Places
from orchestra.resolve.model import ResolvedComponent
from orchestra.resolve.rcl.scalars import typed

if TYPE_CHECKING:
    from typing import TypeAlias

    from orchestra.errors import Problems
    from orchestra.location import Span
    from orchestra.plan.model import Component, Plan, Process
    from orchestra.resolve.model import Resolved, ResolvedProcess
    from orchestra.values import ParameterValue

    _Node: TypeAlias = "tuple[ResolvedProcess | ResolvedComponent, Process | Component]"
    _Given: TypeAlias = "tuple[ResolvedProcess | ResolvedComponent, Process | Component, ParameterValue]"

_KINDS: Final = {float: "a float", int: "an integer", bool: "a boolean"}
_MISTAKEN: Final = (int, str)
_TOLD: Final = (Code.DECLARED_TYPE, Code.SURPRISING_SCALAR, Code.REFUSED_VALUE)


def check_unlike(resolved: Resolved, plan: Plan, problems: Problems) -> None:
    """Report values that are no floats where another node of the same program has one, and such in quotes."""
    odd = _odd(resolved, plan)
    if not odd:
        return
    programs: dict[tuple[str | None, str], list[_Node]] = {}
    for node, planned in nodes_of(resolved, plan):
        called = node.plugin if isinstance(node, ResolvedComponent) else node.executable
        if planned.parameters and (node.package, called) in odd and not node.faulty:
            programs.setdefault((node.package, called), []).append((node, planned))
    places, told = Places(resolved), {item.span for item in problems if item.code in _TOLD}
    for program, nodes in programs.items():
        given: dict[str, list[_Given]] = {name: [] for name in sorted(odd[program])}
        for node, planned in nodes:
            for name in planned.parameters.keys() & given.keys():
                given[name].append((node, planned, planned.parameters[name]))
        for name, values in given.items():
            _tell(name, program[1], values, places, told, problems)


def _odd(resolved: Resolved, plan: Plan) -> dict[tuple[str | None, str], set[str]]:
    """Return the names of parameters that nodes of one program are given with values of several types, by program."""
    types: dict[tuple[str | None, str], dict[str, type]] = {}
    odd: dict[tuple[str | None, str], set[str]] = {}
    for (_, package, called, _), node, planned in programs_of(resolved, plan):
        values = planned.parameters
        if not values:
            continue
        program = package, called
        kinds = dict(zip(values, map(type, values.values())))  # noqa: B905 - as long as each other
        known = types.get(program)
        if (known is not None and kinds.items() <= known.items()) or package is None or node.faulty:
            continue  # as most nodes of a program
        known = types.setdefault(program, kinds)
        for name, kind in kinds.items() - known.items():
            if known.setdefault(name, kind) is not kind:
                odd.setdefault(program, set()).add(name)
    return odd


def _tell(
    name: str, called: str, given: list[_Given], places: Places, told: set[Span | None], problems: Problems
) -> None:
    """Report the values of a parameter that would be of another node's type if they were written as such."""
    # Here, because few descriptions have such.
    from orchestra.declared.texts import written  # noqa: PLC0415

    firsts: dict[type, _Given] = {}
    for item in given:
        firsts.setdefault(type(item[2]), item)
    meant = [kind for kind in _KINDS if kind in firsts]
    for node, planned, value in given:
        if type(value) not in _MISTAKEN:
            continue
        wanted = next((kind for kind in meant if _as(value, kind) is not None), None)
        place = None if wanted is None else places.of(name, node, planned).value
        if wanted is None or place is None or place.span in told:
            continue
        told.add(place.span)
        other, another, its = firsts[wanted]
        at = places.of(name, other, another).value
        problems.warning(
            Code.DECLARED_TYPE,
            f"'{name}' is {written(value)} here and {written(its)} for another node of '{called}': "
            f"one of the two has the wrong type, this should be {_KINDS[wanted]}",
            place,
            suggestion=_as(value, wanted),
            notes=() if at is None else (f"the other one is at {at}",),
        )


def _as(value: ParameterValue, wanted: type) -> str | None:
    """Return how a value is written with another type, None where it is of that type or cannot be."""
    if type(value) is int and wanted is float:
        from orchestra.declared.texts import written  # noqa: PLC0415 - as above

        return written(float(value))
    return value if isinstance(value, str) and type(typed(value)) is wanted else None
