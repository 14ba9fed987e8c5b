"""What matters of one process, a line each: a word that says what it is, then its value."""

from __future__ import annotations

import json
import shlex
from itertools import groupby
from typing import TYPE_CHECKING

from orchestra.plan.render.conditions import alive_lines, dependency_line, ready_lines
from orchestra.resolve.quantities import SIZES, UNLIMITED
from orchestra.values import Restart

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.plan.model import Process
    from orchestra.values import Limits, ParameterValue, Stop

_WIDTH = 11
_LONGEST = 400  # characters of a value: the description of a robot has thousands, and JSON shows all of them
_DEFAULT = Restart("no")


def process_details(process: Process) -> Iterator[str]:
    """Yield the lines; a setting that has nothing to say has no line."""
    yield from labelled("command", _command(process).split("\n"))
    yield from labelled("folder", [process.cwd] if process.cwd else [])
    yield from labelled("environment", _environment(process))
    yield from labelled(
        "parameters", [f"{name}: {_shortened(scalar(value))}" for name, value in process.parameters.items()]
    )
    yield from labelled("files", [file.path for file in process.parameter_files])
    yield from labelled("remaps", [f"{old} -> {new}" for old, new in process.remappings])
    yield from labelled("output", [_output(process.output)] if process.output else [])
    yield from labelled("after", map(dependency_line, process.depends_on))
    yield from labelled("ready", ready_lines(process.ready) if process.ready else [])
    yield from labelled("alive", alive_lines(process.alive) if process.alive else [])
    yield from labelled("restart", [_restart(process.restart)] if process.restart else [])
    yield from labelled("stop", [_stop(process.stop)] if process.stop else [])
    yield from labelled("limits", _limits(process.limits) if process.limits else [])
    yield from labelled("stdin", ["what is typed"] if process.stdin else [])
    yield from labelled("lifecycle", [process.lifecycle] if process.lifecycle else [])
    yield from labelled("required", ["the run ends with it"] if process.required else [])


def process_kind(process: Process) -> str:
    """Return what a process is: its kind, and where its program is from."""
    described = process.kind.replace("_", " ")
    return f"{described} {process.package}/{process.executable}" if process.package else described


def scalar(value: ParameterValue | None) -> str:
    """Return a parameter value so that its type can be seen: text in quotes, lists in brackets."""
    return json.dumps(value, ensure_ascii=False)


def _shortened(value: str) -> str:
    if len(value) <= _LONGEST:
        return value
    return f"{value[:_LONGEST]} ... ({len(value) - _LONGEST} more characters, see --format json)"


def labelled(label: str, values: Iterator[str] | list[str] | map[str]) -> Iterator[str]:
    """Yield values below each other, the label before the first."""
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


def _restart(restart: Restart) -> str:
    budget = "" if restart.budget is None else f", {restart.budget} times at most"
    growth = "" if restart.growth == _DEFAULT.growth else f", growing by the factor {restart.growth:g}"
    jitter = "" if not restart.jitter else f", up to {100 * restart.jitter:g} % more at random"
    return f"{restart.policy}, after {restart.delay:g} s to {restart.max_delay:g} s{growth}{jitter}{budget}"


def _stop(stop: Stop) -> str:
    return f"{stop.signal}, after {stop.timeout:g} s SIGTERM, after {stop.kill_timeout:g} s more SIGKILL"


def _limits(limits: Limits) -> Iterator[str]:
    if limits.cores is not None:
        exclusive = ", which no other process has" if limits.exclusive else ""
        yield f"cores {', '.join(_ranges(limits.cores))}{exclusive}"
    if limits.nice is not None:
        yield f"nice {limits.nice}"
    if limits.scheduler is not None:
        yield f"scheduler {limits.scheduler}{'' if limits.priority is None else f' at {limits.priority}'}"
    if limits.memory is not None:
        yield f"memory {_bytes(limits.memory)}"
    for name, pair in limits.rlimits.items():
        texts = ["unlimited" if item == UNLIMITED else _amount(name, item) for item in pair]
        yield f"{name} {':'.join(dict.fromkeys(texts))}"


def _ranges(cores: tuple[int, ...]) -> Iterator[str]:
    """Yield numbers that follow each other as ranges."""
    for _, group in groupby(enumerate(cores), lambda item: item[1] - item[0]):
        numbers = [core for _, core in group]
        yield str(numbers[0]) if len(numbers) == 1 else f"{numbers[0]}-{numbers[-1]}"


def _amount(name: str, number: int) -> str:
    return _bytes(number) if name in SIZES else str(number)


def _bytes(size: int) -> str:
    """Return a size in the greatest unit that says it exactly."""
    for unit in ("", "K", "M", "G"):
        if size % 1024 or not size:
            return f"{size}{unit}"
        size //= 1024
    return f"{size}T"
