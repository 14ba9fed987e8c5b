"""Plays a case: starts the run, lets befall it what the case says, waits for its end, and takes down what is left."""

from __future__ import annotations

import os
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

from orchestra.events import Event
from orchestra.supervise.keeping import kernel
from tests.chaos.acting import Actor, Delivery, read_events
from tests.chaos.describing import prepared
from tests.chaos.screens import Audience
from tests.chaos.stage import staged

if TYPE_CHECKING:
    import subprocess
    from pathlib import Path

    from tests.chaos.cases import Case
    from tests.chaos.stage import Stage

# What lasts longer after the last act is a hang; in seconds. Generous: several runs share the machine.
HANG = 40.0
_LOOK_AGAIN = 0.05
# Two runs in one domain have shared memory of the same names, and what one uses is left alone by the other.
_DOMAINS = 100


@dataclass(frozen=True, slots=True)
class Remains:
    """What is left when all should be over."""

    processes: tuple[str, ...]
    sockets: tuple[str, ...]
    litter: tuple[str, ...]
    groups: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Observation:
    """What was seen of a run. `status` is None where it never ended; `lasted` are the seconds after the last act.

    `logs` maps the names of processes to the files with their output. `fault` tells of events that cannot be read.
    """

    status: int | None
    lasted: float
    deliveries: tuple[Delivery, ...]
    events: tuple[Event, ...]
    fault: str | None
    logs: dict[str, bytes]
    screen: str
    remains: Remains


def play(case: Case, folder: Path) -> Observation:
    """Play a case in an empty folder. The calling process is a subreaper from then on."""
    kernel.become_subreaper()
    cookie = f"chaos-{os.getpid()}-{time.monotonic_ns():x}"
    with staged(folder, case.disk) as stage:
        audience = Audience(case.screen, folder)
        command = (*stage.through, *prepared(case, folder, cookie))
        popen = audience.begin(command, {**stage.environment, "ROS_DOMAIN_ID": str(os.getpid() % _DOMAINS)})
        actor = Actor(case, stage, popen.pid, audience, cookie, lambda: popen.poll() is not None)
        try:
            actor.perform()
            begin = time.monotonic()
            _await_end(popen, stage, audience, begin + HANG)
            lasted = time.monotonic() - begin
            actor.leave()
            return _observation(case, popen.poll(), lasted, actor, stage, audience)
        finally:
            actor.leave()
            stage.clear()
            audience.leave()
            popen.wait()


def _await_end(popen: subprocess.Popen[bytes], stage: Stage, audience: Audience, deadline: float) -> None:
    """Wait until the run has ended and nothing of it is left."""
    while popen.poll() is None or stage.processes():
        audience.watch()
        if time.monotonic() > deadline:
            return
        time.sleep(_LOOK_AGAIN)


def _observation(
    case: Case, status: int | None, lasted: float, actor: Actor, stage: Stage, audience: Audience
) -> Observation:
    fault = None
    try:
        events = read_events(stage)
    except ValueError as error:
        events, fault = [], str(error)
    remains = Remains(
        tuple(f"{text} (pid {pid})" for pid, text in stage.processes().items()),
        tuple(stage.sockets()),
        tuple(stage.litter()),
        tuple(stage.groups(actor.keeper)),
    )
    names = [root.member.name for root in case.roots]
    logs = {name: _log(stage, name) for name in names}
    deliveries = tuple(actor.deliveries)
    return Observation(status, lasted, deliveries, tuple(events), fault, logs, audience.report(), remains)


def _log(stage: Stage, name: str) -> bytes:
    found = sorted(stage.seen(stage.home).glob(f"runs/*/logs/{name}.log"))
    return b"".join(path.read_bytes() for path in found)
