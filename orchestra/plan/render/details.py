"""What matters of one process, a line each: a word that says what it is, then its value."""

from __future__ import annotations

import json
import shlex
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.plan.conditions import Dependency, Ready
    from orchestra.plan.model import Process
    from orchestra.values import ParameterValue, Restart, Stop

_WIDTH = 11
_LONGEST = 400  # characters of a value: the description of a robot has thousands, and JSON shows all of them
_REACHED = {
    "started": "has started",
    "ready": "is ready",
    "completed": "has completed",
    "exited": "has exited",
}


def process_details(process: Process) -> Iterator[str]:
    """Yield the lines; a setting that has nothing to say has no line."""
    yield from _labelled("command", _command(process).split("\n"))
    yield from _labelled("folder", [process.cwd] if process.cwd else [])
    yield from _labelled("environment", _environment(process))
    yield from _labelled(
        "parameters", [f"{name}: {_shortened(scalar(value))}" for name, value in process.parameters.items()]
    )
    yield from _labelled("files", [file.path for file in process.parameter_files])
    yield from _labelled("remaps", [f"{old} -> {new}" for old, new in process.remappings])
    yield from _labelled("output", [_output(process.output)] if process.output else [])
    yield from _labelled("after", map(_dependency, process.depends_on))
    yield from _labelled("ready", [_ready(process.ready)] if process.ready else [])
    yield from _labelled("restart", [_restart(process.restart)] if process.restart else [])
    yield from _labelled("stop", [_stop(process.stop)] if process.stop else [])
    yield from _labelled("lifecycle", [process.lifecycle] if process.lifecycle else [])
    yield from _labelled("required", ["the run ends with it"] if process.required else [])


def scalar(value: ParameterValue | None) -> str:
    """Return a parameter value so that its type can be seen: text in quotes, lists in brackets."""
    return json.dumps(value, ensure_ascii=False)


def _shortened(value: str) -> str:
    if len(value) <= _LONGEST:
        return value
    return f"{value[:_LONGEST]} ... ({len(value) - _LONGEST} more characters, see --format json)"


def _labelled(label: str, values: Iterator[str] | list[str] | map[str]) -> Iterator[str]:
    for value in values:
        yield f"{label:<{_WIDTH}} {value}"
        label = ""


def _command(process: Process) -> str:
    return f"sh: {' '.join(process.command)}" if process.shell else shlex.join(process.command)


def _output(output: str | dict[str, tuple[str, ...]]) -> str:
    if isinstance(output, str):
        return output
    return ", ".join(f"{stream} to {' and '.join(places)}" for stream, places in output.items())


def _environment(process: Process) -> Iterator[str]:
    if not process.inherit_environment:
        yield "nothing but"
    for name, value in process.environment.items():
        yield f"{name} unset" if value is None else f"{name}={shlex.quote(value)}"


def _dependency(dependency: Dependency) -> str:
    return f"{dependency.process} {_REACHED[dependency.condition]}{_within(dependency.timeout)}"


def _ready(ready: Ready) -> str:
    if ready.message is not None:
        awaited = f"at the first message on {ready.message}"
    else:
        awaited = f"at a line of output that matches {ready.log!r}"
    return awaited + _within(ready.timeout)


def _restart(restart: Restart) -> str:
    budget = "" if restart.budget is None else f", {restart.budget} times at most"
    return f"{restart.policy}, after {restart.delay:g} s to {restart.max_delay:g} s{budget}"


def _stop(stop: Stop) -> str:
    return f"{stop.signal}, after {stop.timeout:g} s SIGTERM, after {stop.kill_timeout:g} s more SIGKILL"


def _within(timeout: float | None) -> str:
    return "" if timeout is None else f", within {timeout:g} s"
