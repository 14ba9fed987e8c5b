"""What processes are called in a plan, and nodes that were given the same name."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.names import full_name

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.errors import Problems
    from orchestra.location import Location, Span
    from orchestra.resolve.model import ResolvedProcess


def identities(processes: Sequence[ResolvedProcess]) -> tuple[str, ...]:
    """Return an id per process: the full node name, else namespace and label, with `#2` for repeats."""
    numbers: dict[str, int] = {}
    taken: set[str] = set()
    ids = []
    for process in processes:
        base = identity = base_identity(process)
        while identity in taken:
            numbers[base] = numbers.get(base, 1) + 1
            identity = f"{base}#{numbers[base]}"
        taken.add(identity)
        ids.append(identity)
    return tuple(ids)


def base_identity(process: ResolvedProcess) -> str:
    """Return the name of a process before repeats are told apart."""
    namespace = process.namespace.text if process.namespace is not None else "/"
    if process.kind == "process":
        return process.label or process.executable
    name = process.name.text if process.name is not None else process.label or Path(process.executable).name
    return full_name(namespace, name)


def node_name(process: ResolvedProcess) -> str | None:
    """Return the full name of a node where it is known."""
    if process.kind == "process" or process.name is None:
        return None
    return full_name(process.namespace.text if process.namespace is not None else "/", process.name.text)


def check_names(processes: Sequence[ResolvedProcess], problems: Problems) -> None:
    """Report nodes that were given the same full name; only a warning where a condition stands on one of them."""
    first: dict[str, ResolvedProcess] = {}
    told: set[tuple[Location | Span, Location | Span]] = set()
    for process in processes:
        name = node_name(process)
        if name is None or process.name is None:
            continue
        earlier = first.setdefault(name, process)
        mistake = _mistake(earlier, process)
        if earlier is process or mistake in told:
            continue
        told.add(mistake)
        report = problems.warning if earlier.conditional or process.conditional else problems.error
        report(
            Code.DUPLICATE_NODE,
            f"two nodes are called '{name}'",
            process.name.location,
            notes=(f"the other one is at {_with_includes(earlier.location)}",),
        )


def _mistake(one: ResolvedProcess, other: ResolvedProcess) -> tuple[Location | Span, Location | Span]:
    """Return what makes two nodes of one name one mistake: within a file it is one, however often it is included."""
    if one.location.included_from == other.location.included_from:
        return one.location.span, other.location.span
    return one.location, other.location


def _with_includes(location: Location) -> str:
    return ", included from ".join(str(span) for span in (location.span, *location.included_from))
