"""What a process waits for, as lines of bash; what a shell cannot see is a comment."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from orchestra.plan.render.conditions import dependency_line, ready_lines
from orchestra.plan.render.shell.words import comment, word, words

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from orchestra.plan.conditions import Dependency, Ready
    from orchestra.plan.model import Process

FOREVER = 0


def probe(process: Process, number: int) -> list[str]:
    """Return the function that tells whether a process is ready, nothing where a shell cannot tell."""
    checks = list(_checks(process.ready, number)) if process.ready is not None else []
    if not checks:
        return []
    lines = [f"  {check} || return" for check in checks]
    return [f"ready_{number}() {{", *lines, "}"]


def is_seen(ready: Ready | None) -> bool:
    """Return whether a shell can tell something of what makes a process ready."""
    return ready is not None and any(True for _ in _checks(ready, 0))


def notes(process: Process) -> Iterator[str]:
    """Yield what is said about a process: what it waits for, and when it is ready."""
    for edge in process.depends_on:
        yield comment(f"after: {dependency_line(edge)}")
    if process.ready is not None:
        for line in ready_lines(process.ready):
            yield comment(f"ready: {line}")
        if not is_seen(process.ready):
            yield comment("A shell cannot see that: who waits for it waits for the start alone.")


def _checks(ready: Ready, number: int) -> Iterator[str]:
    if ready.log is not None:
        yield f'grep -Pq -e {word(ready.log)} -- "$run/logs/{number}.log"'
    if ready.tcp is not None:
        host, _, port = ready.tcp.rpartition(":")
        address = f"/dev/tcp/{host.strip('[]')}/{port}"
        yield f"(exec 9<>{word(address)}) 2>/dev/null"
    if ready.http is not None:
        yield f"curl -fs -o /dev/null --max-time 2 -- {word(ready.http)}"
    if ready.file is not None:
        yield f"(around_{number}; test -e {word(ready.file)})"
    if ready.command is not None:
        yield f"(around_{number}; exec -- {words(ready.command)}) </dev/null >/dev/null 2>&1"


def waits(process: Process, numbers: Mapping[str, int], others: Mapping[str, Process]) -> list[str]:
    """Return the conditions, each a line of bash that succeeds once it has come about and fails where it cannot."""
    lines = []
    for edge in process.depends_on:
        number = numbers.get(edge.process)
        if number is not None:
            lines.append(_wait(edge, number, others[edge.process]))
    return lines


def _wait(edge: Dependency, number: int, other: Process) -> str:
    limit = FOREVER if edge.timeout is None else math.ceil(edge.timeout)
    match edge.condition:
        case "started":
            return f"started {number}"
        case "ready" if is_seen(other.ready):
            own = other.ready.timeout if other.ready is not None else None
            limit = math.ceil(own) if limit == FOREVER and own is not None else limit
            return f"wait_for {number} {limit} ready_{number}"
        case "ready":
            return f"started {number}"
        case "exited":
            return f"over {number}"
        case "completed":
            codes = "|".join(map(str, other.success_exit_codes or (0,)))
            return f"over {number} && [[ ${{ended[{number}]}} =~ ^({codes})$ ]]"
