"""When a process starts, and what is done about it from then on: in words."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

from orchestra.plan.render.conditions import alive_lines, dependency_line, ready_lines
from orchestra.resolve.quantities import SIZES, UNLIMITED
from orchestra.values import Restart

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from orchestra.plan.model import Process
    from orchestra.values import Limits, Stop

_DEFAULT = Restart("no")


def conduct(process: Process) -> Iterator[tuple[str, Iterable[str]]]:
    """Yield each setting: its label, and what it says, a line each; none where it has nothing to say."""
    yield "after", map(dependency_line, process.depends_on)
    yield "ready", ready_lines(process.ready) if process.ready else ()
    yield "alive", alive_lines(process.alive) if process.alive else ()
    yield "restart", [_restart(process.restart)] if process.restart else ()
    yield "stop", [_stop(process.stop)] if process.stop else ()
    yield "limits", _limits(process.limits) if process.limits else ()
    yield "stdin", ["what is typed"] if process.stdin else ()
    yield "lifecycle", [process.lifecycle] if process.lifecycle else ()


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
