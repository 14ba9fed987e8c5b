"""Containers that Orchestra has itself, for components in Python.

They are called as those of rclcpp_components. They take the place of those where that package is not installed and
nothing is loaded that is not in Python, and where it is and all components are named as `module:Class`, which it cannot
load. This is known when everything has been visited.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.description.text import Template
from orchestra.fields import replace
from orchestra.resolve.context import Context, Value
from orchestra.resolve.names import full_name
from orchestra.resolve.refusals import report_missing_package
from orchestra.witness.once import once

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.errors import Problem
    from orchestra.resolve.context import Packages
    from orchestra.resolve.model import ResolvedComponent, ResolvedProcess
    from orchestra.resolve.packages.entry_points import EntryPoint
    from orchestra.resolve.resolution import Resolution

_CPP: Final = "rclcpp_components"
# Those after the first are ours alone: `rclpy_components` as it is proposed for rclpy, where that is not installed.
_PACKAGES: Final = (_CPP, "rclpy_components", "orchestra")
_EXECUTABLES: Final = ("component_container", "component_container_mt", "component_container_isolated")
# What such a container is called where nobody gives it a name.
_NAME: Final = "ComponentManager"


@dataclass(frozen=True, slots=True)
class StandIn:
    """A container of ours in the place of another: the words of both, and what to tell of that one's package."""

    words: tuple[str, ...]
    others: tuple[str, ...]
    package: Value
    written: Template
    context: Context


def own_words(
    package: Value, executable: Value, written: Template, run: Resolution
) -> tuple[str, ...] | None:
    """Return the words that start a container of ours, None where it is none; `written` names the package."""
    words = container_words(package.text, executable.text, run.context.packages)
    if words is not None and package.text == _CPP:
        others = (f"${{prefix:{_CPP}}}/lib/{_CPP}/{executable.text}",)
        run.found.stand_ins.append(StandIn(words, others, package, written, replace(run.context)))
    return words


def container_words(package: str, executable: str, packages: Packages) -> tuple[str, ...] | None:
    """Return the words that start a container of ours where an executable is one, or the package of that is missing."""
    if package not in _PACKAGES or executable not in _EXECUTABLES:
        return None
    missing = package == _PACKAGES[-1] or packages.prefix(package) is None
    return _words(executable) if missing else None


def known_components(run: Resolution) -> tuple[EntryPoint, ...]:
    """Return the components that distributions declare, which are looked for once where code is imported from."""
    # Here and below, because few plans have components.
    from orchestra.resolve.packages.components import declared_components  # noqa: PLC0415

    path = tuple(sys.path)

    def found() -> tuple[EntryPoint, ...]:
        if path not in run.components:
            run.components[path] = declared_components()
        return run.components[path]

    return once(("components", *path), found)


def settle_containers(run: Resolution) -> None:
    """Decide for each container of rclcpp_components whether it is one of ours, by what is loaded into it."""
    stand_ins, run.found.stand_ins = run.found.stand_ins, []
    for index, process in enumerate(run.found.processes):
        if process.package != _CPP or process.executable not in _EXECUTABLES:
            continue
        stand_in = next((one for one in stand_ins if one.words is process.program), None)
        if stand_in is not None:
            _put_back(stand_in, index, run)
        elif run.context.packages.prefix(_CPP) is not None:
            components = [*_loaded_into(index, process, run)]
            from orchestra.resolve.packages.components import is_named_by_module  # noqa: PLC0415 - as above

            if components and all(is_named_by_module(one.plugin) for one in components):
                run.found.put_process(index, replace(process, program=_words(process.executable)))


def _words(executable: str) -> tuple[str, ...]:
    return (sys.executable, "-m", "orchestra.ros.container", executable)


def _put_back(stand_in: StandIn, index: int, run: Resolution) -> None:
    """Put back a container into which something is loaded that is not in Python, and tell of its missing package."""
    process = run.found.processes[index]
    foreign = [one for one in _loaded_into(index, process, run) if not _is_ours(one, run)]
    if not foreign:
        return
    run.found.put_process(index, replace(process, program=stand_in.others))
    known = {id(problem) for problem in run.problems}
    report_missing_package(stand_in.package.text, stand_in.written, stand_in.context, stand_in.package)
    first, others = foreign[0], len(foreign) - 1
    more = f" and {others} more are" if others else " is"
    note = f"Orchestra's own container takes components in Python: '{first.plugin}'{more} not"

    def explained(problem: Problem) -> Problem:
        return problem if id(problem) in known else replace(problem, notes=(*problem.notes, note))

    run.problems.amend(explained)


def _is_ours(component: ResolvedComponent, run: Resolution) -> bool:
    from orchestra.resolve.packages.components import target_of  # noqa: PLC0415 - as above

    known = known_components(run)
    return component.faulty or target_of(component.package, component.plugin, known) is not None


def _loaded_into(index: int, process: ResolvedProcess, run: Resolution) -> Iterator[ResolvedComponent]:
    namespace = "/" if process.namespace is None else process.namespace.text
    name = full_name(namespace, _NAME if process.name is None else process.name.text)
    for component in run.found.components:
        if component.container_process is not None:
            found = component.container_process == index
        elif component.container is not None:
            found = component.container.text == name
        else:
            found = process.origin is not None and component.container_origin is process.origin
        if found:
            yield component
