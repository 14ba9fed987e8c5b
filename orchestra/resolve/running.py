"""What `node` and `executable` have in common, resolved."""

from __future__ import annotations

import re
import shlex
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeVar

from orchestra.resolve.booleans import boolean
from orchestra.resolve.context import POISON, Poison, Value
from orchestra.resolve.dependencies import dependency, readiness
from orchestra.resolve.model import (
    EnvironmentChange,
    ParameterSource,
    ResolvedProcess,
    ResolvedRemap,
    ResolvedStart,
)
from orchestra.resolve.policies import restart, stop
from orchestra.resolve.words import split

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.running import Running
    from orchestra.description.text import Template
    from orchestra.resolve.resolution import Resolution

_T = TypeVar("_T")


@dataclass(frozen=True, slots=True, kw_only=True)
class Program:
    """What is run: the part in which nodes and other programs differ."""

    kind: Literal["process", "node"]
    executable: str
    words: tuple[str, ...]
    package: str | None = None
    name: Value | None = None
    namespace: Value | None = None
    label: str | None = None
    arguments: tuple[str, ...] = ()
    ros_arguments: tuple[str, ...] | None = None
    parameters: tuple[ParameterSource, ...] = ()
    remaps: tuple[ResolvedRemap, ...] = ()
    faulty: bool = False


def add_process(action: Running, program: Program, run: Resolution) -> None:
    """Add a process to what has been found: it starts with the run, or with the timer around it."""
    edges = [dependency(item, run) for item in action.depends_on]
    ready = readiness(action.ready, run) if action.ready is not None else None
    codes = [run.integer(code) for code in action.success_exit_codes or ()]
    cwd, output, shell = run.text(action.cwd), run.text(action.output), run.flag(action.shell, default=False)
    prefix, emulate_tty = _prefix(action, program, run), _emulate_tty(action, run)
    again, end = restart(action, run), stop(action, run)
    required = run.flag(action.required, default=action.on_exit is not None)
    environment, whole = _environment(action, run)
    faulty = (
        program.faulty
        or action.faulty
        or not whole
        or any(
            isinstance(value, Poison)
            for value in (cwd, output, shell, prefix, emulate_tty, again, end, required, *codes)
        )
        or None in edges
        or (action.ready is not None and ready is None)
    )
    location = run.at(action.span)
    process = ResolvedProcess(
        kind=program.kind,
        package=program.package,
        executable=program.executable,
        name=program.name,
        namespace=program.namespace,
        label=program.label,
        program=program.words,
        arguments=program.arguments,
        ros_arguments=program.ros_arguments,
        prefix=() if isinstance(prefix, Poison) else prefix,
        shell=shell is True,
        cwd=_or_none(cwd),
        environment=environment,
        parameters=program.parameters,
        remaps=program.remaps,
        output=_or_none(output),
        emulate_tty=_or_none(emulate_tty),
        restart=_or_none(again),
        required=required is True,
        stop=_or_none(end),
        shutdown_on_exit=action.on_exit is not None,
        success_exit_codes=_sound(codes) if action.success_exit_codes is not None else None,
        ready=ready,
        depends_on=run.frame.depends_on + _sound(edges),
        labels=run.frame.labels,
        location=location,
        conditional=run.conditional,
        faulty=faulty,
    )
    if run.delayed is not None:
        run.delayed.append(ResolvedStart(len(run.found.processes), location))
    run.found.processes.append(process)


def texts(template: Template | None, run: Resolution) -> tuple[str, ...] | Poison:
    """Split a text into words as a shell would."""
    if template is None:
        return ()
    words = split(template, run.context)
    return POISON if isinstance(words, Poison) else tuple(word.text for word in words)


def _or_none(value: _T | Poison | None) -> _T | None:
    return None if isinstance(value, Poison) else value


def _sound(values: Sequence[_T | Poison | None]) -> tuple[_T, ...]:
    return tuple(value for value in values if value is not None and not isinstance(value, Poison))


def _prefix(action: Running, program: Program, run: Resolution) -> tuple[str, ...] | Poison:
    """Return the words of the launch prefix: the action's own, or the one of the whole launch through its filter."""
    if action.launch_prefix is not None:
        return texts(action.launch_prefix, run)
    prefix = _setting("launch-prefix", run)
    if not prefix or not program.words:
        return ()
    chosen = re.match(_setting("launch-prefix-filter", run) or "", Path(program.words[0]).name)
    return tuple(shlex.split(prefix)) if chosen else ()


def _emulate_tty(action: Running, run: Resolution) -> bool | Poison | None:
    setting = _setting("emulate_tty", run)
    return boolean(setting) if setting is not None else run.flag(action.emulate_tty)


def _setting(name: str, run: Resolution) -> str | None:
    """Return a variable that upstream gives a meaning of its own."""
    variable = run.scope.variables.get(name)
    return variable.value.text if variable is not None and isinstance(variable.value, Value) else None


def _environment(action: Running, run: Resolution) -> tuple[dict[str, tuple[EnvironmentChange, ...]], bool]:
    """Return what the description changes in the environment, and whether all of it is sound."""
    changes = dict(run.scope.changes)
    whole = True
    for pair in action.env:
        name, value = run.text(pair.name), run.text(pair.value)
        if isinstance(name, str) and isinstance(value, str):
            change = EnvironmentChange(value, run.at(pair.value.span))
            changes[name] = (*changes.get(name, ()), change)
        else:
            whole = False
    return changes, whole
