"""What a process waits for, when it counts as ready, and how it shows that it lives: in words."""

from __future__ import annotations

import json
import shlex
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.plan.conditions import Alive, Dependency, Ready

_REACHED = {
    "started": "has started",
    "ready": "is ready",
    "completed": "has completed",
    "exited": "has exited",
}
_TRIED = ("tcp", "http", "file", "command")


def dependency_line(dependency: Dependency) -> str:
    """Return one dependency."""
    optional = "" if dependency.required else ", if that can come about"
    return f"{dependency.process} {_REACHED[dependency.condition]}{within(dependency.timeout)}{optional}"


def ready_lines(ready: Ready) -> Iterator[str]:
    """Yield what has to come about, a line each; the last one says how long it is waited for."""
    facts = list(_facts(ready))
    tried = any(getattr(ready, key) is not None for key in _TRIED)
    often = f", tried every {ready.interval:g} s" if tried else ""
    for index, fact in enumerate(facts):
        last = f"{within(ready.timeout)}{often}" if index == len(facts) - 1 else ""
        yield f"{'and ' if index else ''}at {fact}{last}"


def _facts(ready: Ready) -> Iterator[str]:
    yield from _facts_of_ros(ready)
    if ready.log is not None:
        yield f"a line of output that matches {ready.log!r}"
    if ready.tcp is not None:
        yield f"a connection to {ready.tcp}"
    if ready.http is not None:
        yield f"an answer of {ready.http}"
    if ready.file is not None:
        yield f"the file {ready.file}"
    if ready.command is not None:
        yield f"the success of: {shlex.join(ready.command)}"
    if ready.notify:
        yield "its own word, READY=1"


def _facts_of_ros(ready: Ready) -> Iterator[str]:
    if ready.message is not None:
        yield f"the first message on {ready.message}"
    if ready.topic is not None:
        yield f"a publisher on {ready.topic}"
    if ready.node is not None:
        yield f"the node {ready.node}"
    if ready.service is not None:
        yield f"a server of {ready.service}"
    if ready.action is not None:
        yield f"a server of the action {ready.action}"
    if ready.parameter is not None:
        value = ready.parameter.value
        told = "" if value is None else f" = {json.dumps(value, ensure_ascii=False)}"
        yield f"the parameter {ready.parameter.name}{told} of {ready.parameter.node}"
    if ready.lifecycle is not None:
        yield f"the state {ready.lifecycle.state} of {ready.lifecycle.node}"
    if ready.tf is not None:
        yield f"a transform from {ready.tf.child} to {ready.tf.parent}"


def alive_lines(alive: Alive) -> Iterator[str]:
    """Yield the signs of life, a line each, and what becomes of a process that hangs."""
    if alive.notify is not None:
        yield f"says WATCHDOG=1 every {alive.notify:g} s"
    if alive.message is not None and alive.min_rate is not None:
        yield f"{alive.min_rate:g} messages a second on {alive.message}, on the average of {alive.window:g} s"
    if alive.command is not None:
        yield f"success of: {shlex.join(alive.command)}"
        yield (
            f"  started every {alive.interval:g} s, {alive.timeout:g} s long at most, "
            f"{alive.failures} {'failure is' if alive.failures == 1 else 'failures in a row are'} a hang"
        )
    if alive.abort:
        yield "ended with SIGABRT where it hangs"


def within(timeout: float | None) -> str:
    """Return how long something is waited for."""
    return "" if timeout is None else f", within {timeout:g} s"
