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
from orchestra.errors import Problems
from orchestra.fields import replace
from orchestra.resolve.context import Context, Value
from orchestra.resolve.names import full_name
from orchestra.resolve.refusals import forget_surprise, report_missing_package
from orchestra.witness.once import once

if TYPE_CHECKING:
    from collections.abc import Sequence

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
    stand_ins, run.found.stand_ins = {id(one.words): one for one in run.found.stand_ins}, []
    loaded: _Loaded | None = None
    for index, process in enumerate(run.found.processes):
        if process.package != _CPP or process.executable not in _EXECUTABLES:
            continue
        loaded = loaded or _Loaded(run.found.components)
        stand_in = stand_ins.get(id(process.program))
        if stand_in is not None:
            _put_back(stand_in, index, loaded.into(index, process), run)
        elif run.context.packages.prefix(_CPP) is not None:
            components = loaded.into(index, process)
            from orchestra.resolve.packages.components import is_named_by_module  # noqa: PLC0415 - as above

            if components and all(is_named_by_module(one.plugin) for one in components):
                run.found.put_process(index, replace(process, program=_words(process.executable)))


def _words(executable: str) -> tuple[str, ...]:
    return (sys.executable, "-m", "orchestra.ros.container", executable)


def _put_back(
    stand_in: StandIn, index: int, components: Sequence[ResolvedComponent], run: Resolution
) -> None:
    """Put back a container into which something is loaded that is not in Python, and tell of its missing package."""
    foreign = [one for one in components if not _is_ours(one, run)]
    if not foreign:
        return
    run.found.put_process(index, replace(run.found.processes[index], program=stand_in.others))
    found = Problems()
    context = replace(stand_in.context, problems=found)
    report_missing_package(stand_in.package.text, stand_in.written, context, stand_in.package)
    first, others = foreign[0], len(foreign) - 1
    more = f" and {others} more are" if others else " is"
    note = f"Orchestra's own container takes components in Python: '{first.plugin}'{more} not"
    for problem in found:
        if problem.span is not None and problem.suggestion is not None:
            forget_surprise(problem.span, stand_in.context.problems)
        stand_in.context.problems.report(replace(problem, notes=(*problem.notes, note)))


def _is_ours(component: ResolvedComponent, run: Resolution) -> bool:
    from orchestra.resolve.packages.components import target_of  # noqa: PLC0415 - as above

    known = known_components(run)
    return component.faulty or target_of(component.package, component.plugin, known) is not None


class _Loaded:
    """The components of a plan by what says where they are loaded."""

    def __init__(self, components: Sequence[ResolvedComponent]) -> None:
        self._components = components
        self._by_process: dict[int, list[int]] = {}
        self._by_name: dict[str, list[int]] = {}
        self._by_origin: dict[int, list[int]] = {}
        for place, component in enumerate(components):
            if component.container_process is not None:
                self._by_process.setdefault(component.container_process, []).append(place)
            elif component.container is not None:
                self._by_name.setdefault(component.container.text, []).append(place)
            else:
                self._by_origin.setdefault(id(component.container_origin), []).append(place)

    def into(self, index: int, process: ResolvedProcess) -> list[ResolvedComponent]:
        """Return what is loaded into a container, as it is written."""
        namespace = "/" if process.namespace is None else process.namespace.text
        name = full_name(namespace, _NAME if process.name is None else process.name.text)
        found = [*self._by_process.get(index, ()), *self._by_name.get(name, ())]
        if process.origin is not None:
            found += self._by_origin.get(id(process.origin), ())
        return [self._components[place] for place in sorted(found)]
