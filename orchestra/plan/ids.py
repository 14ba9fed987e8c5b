"""What processes are called in a plan, and nodes that were given the same name."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.names import full_name

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.errors import Problems
    from orchestra.resolve.model import ResolvedProcess


def identities(processes: Sequence[ResolvedProcess]) -> tuple[str, ...]:
    """Return an id per process: the full node name, else namespace and label, with `#2` for repeats."""
    seen: Counter[str] = Counter()
    ids = []
    for process in processes:
        name = base_identity(process)
        seen[name] += 1
        ids.append(name if seen[name] == 1 else f"{name}#{seen[name]}")
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
    for process in processes:
        name = node_name(process)
        if name is None:
            continue
        earlier = first.setdefault(name, process)
        if earlier is process:
            continue
        conditional = earlier.conditional or process.conditional
        report = problems.warning if conditional else problems.error
        at = process.name.location if process.name is not None else process.location
        report(
            Code.DUPLICATE_NODE,
            f"two nodes are called '{name}'",
            at,
            notes=(f"the other one is at {earlier.location}",),
        )
