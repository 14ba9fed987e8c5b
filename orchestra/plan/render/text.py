"""A plan for people: the arguments, a tree of the processes by namespace, what triggers do, what was left out.

The tree is indented and has no lines drawn, so that one node more changes no other node's lines in a comparison.
The same plan always gives the same text.
"""

from __future__ import annotations

import shlex
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from orchestra.plan.model import Process
from orchestra.plan.render.details import process_details, process_kind, scalar
from orchestra.plan.render.setting import Setting
from orchestra.plan.render.triggers import trigger_lines

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.plan.model import Argument, Component, Plan, Skipped

_INDENT = "  "


def render(plan: Plan, setting: Setting = Setting(), /) -> str:  # noqa: B008 - it is frozen
    """Return the plan as text."""
    del setting
    sections = [
        _heading(plan),
        _section("arguments", _arguments(tuple(item for item in plan.arguments if not item.given))),
        _section("processes", _processes(plan.processes)),
        _section("components", map(_component, plan.components)),
        _section("triggers", trigger_lines(plan.triggers)),
        _section("skipped", map(_skipped, plan.skipped)),
    ]
    return "\n".join("".join(f"{line}\n" for line in section) for section in sections if section)


def _heading(plan: Plan) -> list[str]:
    counted = [
        (len(plan.processes), "process", "processes"),
        (len(plan.components), "component", "components"),
        (len(plan.triggers), "trigger", "triggers"),
    ]
    counts = ", ".join(f"{n} {one if n == 1 else many}" for n, one, many in counted if n)
    return [f"{plan.file}: {counts or 'nothing to run'}"]


def _section(title: str, lines: Iterator[str]) -> list[str]:
    """Return the indented lines under their title, nothing where there are none."""
    indented = [f"{_INDENT}{line}" for line in lines]
    return [title, *indented] if indented else []


def _arguments(arguments: tuple[Argument, ...]) -> Iterator[str]:
    width = max((len(argument.name) for argument in arguments), default=0)
    for argument in arguments:
        value = "(no value)" if argument.value is None else shlex.quote(argument.value)
        origin = "" if argument.value == argument.default else _origin(argument)
        yield f"{argument.name:<{width}} := {value}{origin}"


def _origin(argument: Argument) -> str:
    """Return the default, unless the value may be what the default comes to."""
    if argument.default is not None and "$(" in argument.default:
        return ""
    return "  (required)" if argument.default is None else f"  (default {shlex.quote(argument.default)})"


@dataclass(slots=True)
class _Namespace:
    """A namespace of the tree: what is in it, and the namespaces below it, in plan order."""

    processes: list[Process] = field(default_factory=list)
    below: dict[str, _Namespace] = field(default_factory=dict)


def _processes(processes: tuple[Process, ...]) -> Iterator[str]:
    root = _Namespace()
    outside = [process for process in processes if process.namespace is None]
    for process in processes:
        if process.namespace is not None:
            _at(root, process.namespace).processes.append(process)
    for process in outside:
        yield from _process(process)
    if root.processes or root.below:
        yield from _branch("/", root)


def _at(root: _Namespace, namespace: str) -> _Namespace:
    here = root
    for token in namespace.strip("/").split("/"):
        if token:
            here = here.below.setdefault(token, _Namespace())
    return here


def _branch(title: str, namespace: _Namespace) -> Iterator[str]:
    yield title
    for process in namespace.processes:
        yield from (_INDENT + line for line in _process(process))
    for token, below in namespace.below.items():
        yield from (_INDENT + line for line in _branch(f"{token}/", below))


def _process(process: Process) -> Iterator[str]:
    yield f"{process.id}  ({process_kind(process)}, {process.location})"
    yield from (_INDENT + line for line in process_details(process))


def _component(component: Component) -> str:
    told = {**component.parameters, **component.extra_arguments}
    values = "".join(f" {key}={scalar(value)}" for key, value in told.items())
    remaps = "".join(f" {old}->{new}" for old, new in component.remappings)
    elsewhere = "" if component.process is not None else " (not of this plan)"
    place = f"in {component.container}{elsewhere}"
    return f"{component.id}: {component.package}/{component.plugin} {place}{values}{remaps}"


def _skipped(skipped: Skipped) -> str:
    name = f" {skipped.name}" if skipped.name else ""
    came_to = "" if skipped.value == skipped.expression else f", which is {skipped.value}"
    return f"{skipped.action}{name}: {skipped.condition} {skipped.expression}{came_to}  ({skipped.location})"
