"""Carries out what befalls a run."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import signal
import socket
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from orchestra import events
from orchestra.supervise.keeping import proc
from tests.chaos.cases import Act, Case
from tests.chaos.screens import Audience
from tests.chaos.stage import Stage
from tests.supervise.plans import name_of

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.events import Event

_OURS = {"supervisor": "orc-supervisor", "resolver": "orc-resolver", "observer": "orc-observer"}
_KEYS = {"INT": b"\x03", "TSTP": b"\x1a", "QUIT": b"\x1c"}
_LOOK_AGAIN = 0.02
# A process that waits for something that never comes does not start; in seconds.
_ALL_WITHIN = 6.0
_LONGEST_WAIT = 20.0
# What clients say that are no friends: nothing, nonsense, half a line, far too much, many requests at once, and for
# ever without reading an answer.
_CLIENTS = (
    b"",
    b"\xff\x00garbage\n",
    b'{"id": 1, "request": "snap',
    b"[" * 200_000,
    b"{}\nnull\n" * 1000,
    b'{"id": 1, "request": "snapshot"}\n' * 1000,
    b'{"id": 1, "request": "subscribe"}\n',
)
_EACH = 15


@dataclass(frozen=True, slots=True)
class Delivery:
    """What was done, to which process, and when; `pid` None where there was nobody to do it to."""

    act: Act
    at: float
    pid: int | None


@dataclass
class Actor:
    """Has a case's run before it, and does what the case says."""

    case: Case
    stage: Stage
    keeper: int
    audience: Audience
    cookie: str
    over: Callable[[], bool]
    deliveries: list[Delivery] = field(default_factory=list)
    _clients: list[socket.socket] = field(default_factory=list)

    def perform(self) -> None:
        """Do everything, in order, as long as there is a run."""
        self._until(lambda: name_of(self.keeper) == "orc-keeper")
        for act in self.case.acts:
            self._until(_after(act.delay))
            if self.over():
                return
            pid = self._do(act)
            self.deliveries.append(Delivery(act, time.monotonic(), pid))

    def leave(self) -> None:
        """Close what was opened."""
        for client in self._clients:
            client.close()

    def _do(self, act: Act) -> int | None:
        """Do it; return the pid of whom it was done to."""
        at_somebody: dict[str, Callable[[Act], int | None]] = {
            "signal": self._signal,
            "type": lambda act: self.keeper if self.audience.type(_KEYS[act.signal]) else None,
            "hang up": lambda _: self.keeper if self.audience.leave() else None,
        }
        if act.deed in at_somebody:
            return at_somebody[act.deed](act)
        at_all: dict[str, Callable[[], object]] = {
            "fill disk": self._fill,
            "free disk": lambda: self._ballast.unlink(missing_ok=True),
            "remove logs": self._remove_logs,
            "hammer": self._hammer,
            "order": lambda: self._order(act),
            "wait for all": lambda: self._until(self._all_run, _ALL_WITHIN),
            "pass time": lambda: self._until(_after(act.chosen)),
        }
        at_all[act.deed]()
        return None

    def _signal(self, act: Act) -> int | None:
        pid = self._find(act)
        if pid is None:
            return None
        try:
            os.kill(pid, signal.Signals[f"SIG{act.signal}"])
        except ProcessLookupError:
            return None
        return pid

    def _find(self, act: Act) -> int | None:
        if act.target == "keeper":
            return self.keeper
        below = proc.descendants(os.getpid())
        if act.target == "member":
            found = sorted(pid for pid in below if self.cookie in proc.command(pid))
            return found[int(act.chosen * len(found))] if found else None
        return next((pid for pid in below if name_of(pid) == _OURS[act.target]), None)

    def _all_run(self) -> bool:
        running = {event.process for event in read_events(self.stage) if event.kind == "process_running"}
        return len(running) == len(self.case.roots)

    @property
    def _ballast(self) -> Path:
        return self.stage.seen(self.stage.home) / "ballast"

    def _fill(self) -> None:
        with contextlib.suppress(OSError), self._ballast.open("ab", buffering=0) as file:
            while True:
                file.write(bytes(1024))

    def _remove_logs(self) -> None:
        for folder in self.stage.seen(self.stage.home).glob("runs/*/logs"):
            shutil.rmtree(folder, ignore_errors=True)

    def _hammer(self) -> None:
        """Connect to every socket of the run, and say too much, too little, nonsense or nothing."""
        for words in _CLIENTS * _EACH:
            self._call(words)

    def _order(self, act: Act) -> None:
        """Ask for something as `orchestra stop` does, and do not wait for the answer."""
        root = self.case.roots[int(act.chosen * len(self.case.roots))]
        request = {"id": 1, "request": act.order, "processes": [root.member.name], "wait": False}
        self._call(json.dumps(request).encode() + b"\n")

    def _call(self, words: bytes) -> None:
        """Say something on a connection of its own, which stays open until the run is over."""
        for path in self.stage.socket_files():
            client = socket.socket(socket.AF_UNIX)
            client.setblocking(False)
            self._clients.append(client)
            with contextlib.suppress(OSError):
                client.connect(str(path))
                client.send(words)

    def _until(self, condition: Callable[[], bool], seconds: float = _LONGEST_WAIT) -> None:
        """Wait for a condition; a run that does not get there is judged as it is."""
        late = _after(seconds)
        while not self.over() and not condition() and not late():
            self.audience.watch()
            time.sleep(_LOOK_AGAIN)


def _after(seconds: float) -> Callable[[], bool]:
    deadline = time.monotonic() + seconds
    return lambda: time.monotonic() >= deadline


def read_events(stage: Stage) -> list[Event]:
    """Return the events that have been written in whole; a line that is none is a `ValueError`."""
    found: list[Event] = []
    for path in stage.seen(stage.home).glob("runs/*/events.jsonl"):
        lines = path.read_text("utf-8").splitlines(keepends=True)
        found.extend(events.loads(line) for line in lines if line.endswith("\n"))
    return found
