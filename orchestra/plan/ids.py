"""What processes are called in a plan, and nodes that were given the same name."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.location import is_python
from orchestra.resolve.model import ResolvedComponent, ResolvedProcess
from orchestra.resolve.names import full_name

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Sequence

    from orchestra.errors import Problems
    from orchestra.location import Location, Span
    from orchestra.resolve.model import Resolved

_TWICE = 2
_TRANSFORM = "static_transform_publisher"


def full_names(processes: Iterable[ResolvedProcess]) -> list[str | None]:
    """Return the full names of those that are nodes, where they are known."""
    return [
        None
        if process.name is None or process.kind == "process"
        else full_name("/" if process.namespace is None else process.namespace.text, process.name.text)
        for process in processes
    ]


def identities(
    processes: Sequence[ResolvedProcess | ResolvedComponent],
    names: Iterable[str | None],
    others: Collection[str] = (),
) -> tuple[str, ...]:
    """Return an id per process: the full node name, else namespace and label, with `#2` for repeats.

    Components have ids as nodes have; `names` are the full names, `others` are ids that are given already.
    """
    bases = [
        base_identity(process) if name is None else name
        for process, name in zip(processes, names, strict=True)
    ]
    numbers: dict[str, int] = {}
    taken = {*bases, *others}
    if len(taken) == len(bases) + len(others):
        return tuple(bases)
    taken = set(others)
    ids = []
    for base in bases:
        identity = base
        while identity in taken:
            numbers[base] = numbers.get(base, 1) + 1
            identity = f"{base}#{numbers[base]}"
        taken.add(identity)
        ids.append(identity)
    return tuple(ids)


def base_identity(process: ResolvedProcess | ResolvedComponent) -> str:
    """Return the name of a process before repeats are told apart."""
    namespace = process.namespace.text if process.namespace is not None else "/"
    if isinstance(process, ResolvedComponent):
        unnamed = process.plugin.rpartition(":")[2]
    elif process.kind == "process":
        return process.label or process.executable
    else:
        unnamed = process.label or (Path(process.executable).name if process.name is None else "")
    return full_name(namespace, process.name.text if process.name is not None else unnamed)


def node_name(process: ResolvedProcess | ResolvedComponent) -> str | None:
    """Return the full name of a node where it is known."""
    name, namespace = process.name, process.namespace
    if name is None or (isinstance(process, ResolvedProcess) and process.kind == "process"):
        return None
    return full_name("/" if namespace is None else namespace.text, name.text)


def check_names(
    resolved: Resolved, names: Sequence[str | None], new: Sequence[int] | None, problems: Problems
) -> None:
    """Report nodes that were given the same full name; those of two ROS domains never meet.

    `names` are those of processes and components; of them only the `new` ones are looked at where that is given.

    It is only a warning where a condition stands on one of them, where one is a component, which its container may
    refuse, and where one is written in Python: files that exist already do this, and upstream starts both. So it is of
    publishers of static transforms, which nobody asks for anything: files that work give all of them one name.
    """
    processes: list[ResolvedProcess | ResolvedComponent] = [*resolved.processes, *resolved.components]
    if new is not None:
        processes, names = [processes[place] for place in new], [names[place] for place in new]
    twice = _tell_twice(processes, problems)
    known = [name for name in names if name is not None]
    if len({*known}) == len(known):
        return
    first: dict[str, ResolvedProcess | ResolvedComponent] = {}
    told: set[tuple[Location | Span, Location | Span]] = set()
    for process, name in zip(processes, names, strict=True):
        if name is None or process.name is None:
            continue
        earlier = first.setdefault(name, process)
        if earlier is process:
            continue
        domain = domain_of(process, resolved.processes)
        if domain != domain_of(earlier, resolved.processes):
            earlier = first.setdefault(f"{name} of {domain}", process)
            if earlier is process:
                continue
        mistake = _mistake(earlier, process)
        if mistake in told or (earlier.origin is process.origin and id(process.origin) in twice):
            continue
        told.add(mistake)
        # Here, because two nodes seldom have one name.
        from orchestra.plan.copied import name_meant  # noqa: PLC0415

        certain = all(map(_is_refused, (earlier, process)))
        report = problems.error if certain else problems.warning
        report(
            Code.DUPLICATE_NODE,
            f"two nodes are called '{name}'",
            process.name.location,
            suggestion=name_meant(earlier, process),
            notes=(f"the other one is at {_with_includes(earlier.location)}",),
        )


def _tell_twice(processes: Sequence[ResolvedProcess | ResolvedComponent], problems: Problems) -> set[int]:
    """Warn of actions of Python that are started twice, which ROS 2 refuses; return their ids.

    What is repeated, and made once in the code, is left alone.
    """
    found: set[int] = set()
    origins = [id(process.origin) for process in processes if process.origin is not None]
    if len({*origins}) == len(origins):
        return found
    times: dict[int, int] = {}
    for process in processes:
        origin = process.origin
        if origin is None or isinstance(process, ResolvedComponent):
            continue
        count = times[id(origin)] = times.get(id(origin), 0) + 1
        if count != _TWICE:  # the code is looked at once, however often a loop starts it
            continue
        # Here, because few actions are, and what it imports.
        from orchestra.compat.side_by_side import second_use  # noqa: PLC0415

        place = getattr(origin, "_place", None)
        span = None if place is None else second_use(place)
        if span is not None:
            found.add(id(origin))
            message = f"the same {type(origin).__name__} is started a second time here: ROS 2 refuses that"
            at, notes = replace(process.location, span=span), (f"it is made at {process.location.span}",)
            problems.warning(Code.DUPLICATE_NODE, message, at, notes=notes)
    return found


def domain_of(
    process: ResolvedProcess | ResolvedComponent | None, containers: Sequence[ResolvedProcess]
) -> str | None:
    """Return the ROS domain that a node is given, where it is; a component has that of its container."""
    if isinstance(process, ResolvedComponent):
        index, name, origin = process.container_process, process.container, process.container_origin
        if index is not None:
            process = containers[index]
        else:
            there = (
                item
                for item in containers
                if (item.origin is origin if name is None else node_name(item) == name.text)
            )
            process = next(there, None)
    changes = () if process is None else process.environment.get("ROS_DOMAIN_ID", ())
    return changes[-1].value if changes else None


def domains_of(resolved: Resolved) -> dict[int, str | None] | None:
    """Return the ROS domains of processes and components by their `id`; None where none is given any."""
    if not any("ROS_DOMAIN_ID" in process.environment for process in resolved.processes):
        return None
    nodes: tuple[ResolvedProcess | ResolvedComponent, ...] = (*resolved.processes, *resolved.components)
    return {id(node): domain_of(node, resolved.processes) for node in nodes}


def _is_refused(process: ResolvedProcess | ResolvedComponent) -> bool:
    """Return whether there must not be another one of its name."""
    if isinstance(process, ResolvedComponent) or process.conditional:
        return False
    if process.executable == _TRANSFORM and process.package in ("tf2_ros", "tf2_ros_py"):
        return False
    return not is_python(process.location)


def _mistake(
    one: ResolvedProcess | ResolvedComponent, other: ResolvedProcess | ResolvedComponent
) -> tuple[Location | Span, Location | Span]:
    """Return what makes two nodes of one name one mistake: within a file it is one, however often it is included."""
    if one.location.included_from == other.location.included_from:
        return one.location.span, other.location.span
    return one.location, other.location


def _with_includes(location: Location) -> str:
    return ", included from ".join(str(span) for span in (location.span, *location.included_from))
