"""Names of parameters that nobody declares: at which level they go wrong, and what was meant."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.declared.model import Fault
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Collection


def misnamed(name: str, known: Collection[str]) -> Fault:
    """Return what is wrong with a name that is none of those `known`.

    The name of the fault ends with the level that goes wrong: `limts` of `limts.max`.
    """
    parts = name.split(".")
    for depth in range(1, len(parts) + 1):
        reached, above = ".".join(parts[:depth]), ".".join(parts[: depth - 1])
        if reached in known:
            told = f"'{name}' is declared by nobody: '{reached}' is a parameter, not a group of them"
            return Fault("undeclared", name, told)
        if any(other.startswith(f"{reached}.") for other in known):
            continue
        return _wrong_level(reached, above, parts, known)
    told = f"'{name}' is a group of parameters, not one"
    return Fault("undeclared", name, told)


def _wrong_level(reached: str, above: str, parts: list[str], known: Collection[str]) -> Fault:
    rest = parts[reached.count(".") + 1 :]
    told = f"'{reached}' is no parameter that this node declares"
    if rest:
        told = f"this node declares no parameters below '{reached}'"
    siblings = _levels(above, known, leaves=not rest)
    near = nearest(reached.removeprefix(f"{above}."), siblings)
    if near is not None:
        return Fault("undeclared", reached, told, f"{above}.{near}" if above else near)
    elsewhere = [other for other in known if other.rpartition(".")[2] == parts[-1]]
    meant = elsewhere[0] if len(elsewhere) == 1 and not rest else None
    return Fault("undeclared", reached, told, meant)


def _levels(above: str, names: Collection[str], *, leaves: bool) -> set[str]:
    """Return the names of the level below a group: of parameters, else of groups."""
    start = f"{above}." if above else ""
    rests = [name.removeprefix(start) for name in names if name.startswith(start)]
    return {rest.partition(".")[0] for rest in rests if leaves != ("." in rest)}
