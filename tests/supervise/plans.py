"""Plans built by hand, and runs of them: a keeper of their own, watched from outside."""

from __future__ import annotations

import contextlib
import itertools
import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from orchestra import events
from orchestra.location import Location, point
from orchestra.plan.conditions import Dependency, Ready
from orchestra.plan.model import VERSION, Component, Plan, Process, Provenance
from orchestra.plan.reactions import (
    DeferredAction,
    LogAction,
    ShutdownAction,
    StartAction,
    Trigger,
    TriggerEvent,
)
from orchestra.supervise.keeping import proc
from orchestra.supervise.options import RunOptions
from orchestra.supervise.resolver import document
from tests.pressure import Deadline

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator

    from orchestra.events import Event
    from orchestra.values import Condition

HERE = Location(point("by_hand.yaml"))
PROCESSES = Path(__file__).parents[1] / "processes"
# Generous: it only ends tests that would otherwise hang.
PATIENCE = 90.0
# Signals 32 and 33 in a set: the C library lets what it starts begin with them ignored, and nobody else can use them.
INTERNAL = 0x180000000
_PLAIN = RunOptions()
_NUMBERS = itertools.count(1)


def stand_in(*words: str) -> tuple[str, ...]:
    """Return the command of a stand-in that does what the words say; `-S -E` starts it faster."""
    return (sys.executable, "-S", "-E", str(PROCESSES / "stand_in.py"), *words)


def process(identity: str, /, *words: str, **changes: Any) -> Process:
    """Return a process that runs a stand-in, or the `command` that is given."""
    fields: dict[str, Any] = {
        "id": identity,
        "kind": "process",
        "package": None,
        "executable": "stand_in",
        "name": None,
        "namespace": None,
        "command": stand_in(*words),
        "shell": False,
        "prefix": (),
        "environment": {},
        "inherit_environment": True,
        "cwd": None,
        "parameters": {},
        "parameter_files": (),
        "remappings": (),
        "arguments": (),
        "output": None,
        "emulate_tty": None,
        "stdin": None,
        "restart": None,
        "required": False,
        "success_exit_codes": None,
        "ready": None,
        "alive": None,
        "lifecycle": None,
        "depends_on": (),
        "stop": None,
        "limits": None,
        "warm": None,
        "machine": None,
        "digest": "",
        "location": HERE,
        "provenance": Provenance(),
    }
    return Process(**{**fields, **changes})


def after(name: str, condition: Condition, timeout: float | None = None) -> tuple[Dependency, ...]:
    """Return the dependency on one process."""
    return (Dependency(name, condition, timeout, HERE),)


def ready_when(log: str | None = None, message: str | None = None, timeout: float | None = None) -> Ready:
    """Return a readiness condition."""
    return Ready(log, message, timeout)


def when(on: TriggerEvent, *actions: Any, identity: str = "", **changes: Any) -> Trigger:
    """Return a trigger with an id of its own."""
    deferred = any(isinstance(action, DeferredAction) for action in actions)
    fields: dict[str, Any] = {"delay": None, "deferred": deferred, "location": HERE, **changes}
    return Trigger(identity or f"t{next(_NUMBERS)}", on, actions, **fields)


def deferred(ref: int, line: int = 1) -> DeferredAction:
    """Return the action that only the resolver knows, written in a line of `by_hand.yaml`."""
    return DeferredAction(ref, Location(point("by_hand.yaml", line)))


def when_ended(target: str, *actions: Any, **changes: Any) -> Trigger:
    """Return a trigger on the end of a process."""
    return when(TriggerEvent("process_exited", target), *actions, **changes)


def at_start(*actions: Any, delay: float | None = None) -> Trigger:
    """Return a trigger on the start of the run."""
    return when(TriggerEvent("run_started"), *actions, delay=delay)


def log(message: str) -> LogAction:
    """Return the action that tells something."""
    return LogAction(message, HERE)


def start(name: str) -> StartAction:
    """Return the action that starts a process."""
    return StartAction(name, HERE)


def shutdown(reason: str) -> ShutdownAction:
    """Return the action that ends the run."""
    return ShutdownAction(reason, HERE)


def plan(
    *processes: Process, triggers: tuple[Trigger, ...] = (), components: tuple[Component, ...] = ()
) -> Plan:
    """Return a plan."""
    return Plan(VERSION, "by_hand.yaml", (), processes, components, triggers, (), ())


def wait_for(condition: Callable[[], Any], what: str, seconds: float = PATIENCE) -> Any:
    """Wait until a condition holds and return what it gave; fail with `what` otherwise."""
    deadline = time.monotonic() + seconds
    while not (result := condition()):
        assert time.monotonic() < deadline, f"waited {seconds} s for {what}"
        time.sleep(0.02)
    return result


@dataclass
class Launched:
    """A run from outside: its keeper, its files, everything below it."""

    popen: subprocess.Popen[bytes]
    home: Path
    out: Path
    err: Path

    @property
    def directory(self) -> Path:
        """The run directory."""
        found = wait_for(lambda: list((self.home / "runs").glob("*")), "the run directory")
        assert len(found) == 1
        path: Path = found[0]
        return path

    @property
    def events(self) -> list[Event]:
        """The events so far."""
        path = self.directory / "events.jsonl"
        text = path.read_text("utf-8") if path.exists() else ""
        return [events.loads(line) for line in text.splitlines(keepends=True) if line.endswith("\n")]

    def kinds(self, name: str) -> list[str]:
        """The kinds of the events of a process, in order."""
        return [event.kind for event in self.events if event.process == name]

    def of_kind(self, kind: str, name: str | None = None) -> list[Event]:
        """The events of a kind, of one process where it is named."""
        return [event for event in self.events if event.kind == kind and name in (None, event.process)]

    def await_event(self, kind: str, name: str | None = None, count: int = 1) -> Event:
        """Wait for the n-th event of a kind."""
        self._await(lambda: len(self.of_kind(kind, name)) >= count, f"event {kind} of {name}")
        return self.of_kind(kind, name)[count - 1]

    def _await(self, condition: Callable[[], Any], what: str) -> None:
        """Wait for a condition; a run that is over will not fulfil it any more."""
        over = self.popen.poll
        try:
            wait_for(lambda: condition() or over() is not None, what)
        except AssertionError as error:
            error.add_note(self.stderr)
            raise
        assert condition(), f"the run ended before {what}: {self.stderr}"

    @property
    def ending(self) -> float:
        """How many seconds the end took, by the events: a busy machine is slow to tell us."""
        begun, ended = (self.of_kind(kind)[0].monotonic for kind in ("run_stopping", "run_ended"))
        return ended - begun

    def log(self, name: str) -> str:
        """The log file of a process."""
        return (self.directory / "logs" / f"{name}.log").read_text("utf-8")

    def await_line(self, name: str, line: str, count: int = 1) -> None:
        """Wait until a line stands in the log file of a process, so many times."""
        path = self.directory / "logs" / f"{name}.log"
        self._await(
            lambda: path.exists() and path.read_text("utf-8").splitlines().count(line) >= count,
            f"{line!r} from {name}",
        )

    def own(self, comm: str) -> int:
        """The pid of one of Orchestra's own processes, by its name."""
        if comm == "orc-keeper":
            return self.popen.pid
        below = wait_for(
            lambda: [pid for pid in proc.descendants(self.popen.pid) if name_of(pid) == comm], comm
        )
        pid: int = below[0]
        return pid

    def everything(self) -> set[int]:
        """All processes of this run at this moment, by descent and by mark."""
        marked = {pid for pid in proc.pids() if proc.marks(pid, ("ORCHESTRA_HOME",)) == (str(self.home),)}
        return {pid for pid in marked | set(proc.descendants(self.popen.pid)) if alive(pid)}

    def send(self, number: int) -> None:
        """Signal the keeper."""
        self.popen.send_signal(number)

    def wait(self, seconds: float = PATIENCE) -> int:
        """Wait for the end and return the exit status."""
        return self.popen.wait(seconds)

    def assert_gone(self, seconds: float = 6.0) -> None:
        """Nothing is left of the run after so many seconds, or up to three times as many on a machine that is busy."""
        await_end(self.everything, seconds)

    @property
    def stdout(self) -> str:
        """What the run wrote to standard output."""
        return self.out.read_text("utf-8", "replace")

    @property
    def stderr(self) -> str:
        """What the run wrote to standard error."""
        return self.err.read_text("utf-8", "replace")


def alive(pid: int) -> bool:
    """Tell whether a process runs: one that has ended and waits to be reaped does not."""
    facts = proc.stat(pid)
    return facts is not None and facts.state not in "ZX"


def assert_ended(pids: set[int]) -> None:
    """None of these processes is left. One that is on its way out has no environment any more, but still a state."""
    await_end(lambda: set(filter(alive, pids)), 2.0)


def await_end(left: Callable[[], Collection[int]], seconds: float) -> None:
    """Wait until nothing is `left`, for so many seconds or, on a machine that is busy, up to three times as many."""
    deadline = Deadline(seconds)
    while pids := left():
        commands = [proc.command(pid) for pid in pids]
        assert not deadline.is_over, f"waited {deadline.allowed:.1f} s for the end of {commands}"
        time.sleep(0.02)


def name_of(pid: int) -> str:
    """Return the short name of a process."""
    try:
        return Path(f"/proc/{pid}/comm").read_text().strip()
    except OSError:
        return ""


@contextlib.contextmanager
def launched(
    folder: Path,
    what: Plan | tuple[str, ...],
    options: RunOptions = _PLAIN,
    *,
    environment: dict[str, str] | None = None,
    through: tuple[str, ...] = (),
    answers: Path | None = None,
    **popen: Any,
) -> Iterator[Launched]:
    """Run a plan, or the launcher with words, and kill at the end what may be left of it.

    `through` are words before the command, such as those of a shell that executes it. With `answers` the resolver stays
    and decides by that file (`deciding.py`).
    """
    home = folder / "home"
    if isinstance(what, Plan):
        path = folder / "document.json"
        path.write_bytes(document.dumps(what, options))
        words = ["launcher.py", str(path)] if answers is None else ["deciding.py", str(path), str(answers)]
    else:
        words = [*what] if what[0].endswith(".py") else ["launcher.py", "-", *what]
    out, err = folder / "out", folder / "err"
    with out.open("wb") as out_file, err.open("wb") as err_file:
        streams = {"stdin": subprocess.DEVNULL, "stdout": out_file, "stderr": err_file}
        started = subprocess.Popen(
            [*through, sys.executable, str(PROCESSES / words[0]), *words[1:]],
            env={**os.environ, "ORCHESTRA_HOME": str(home), **(environment or {})},
            **{**streams, **popen},
        )
    run = Launched(started, home, out, err)
    try:
        yield run
    finally:
        for pid in run.everything():
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        started.wait(PATIENCE)


def finished(
    folder: Path, what: Plan | tuple[str, ...], options: RunOptions = _PLAIN, **kwargs: Any
) -> Launched:
    """Run to the end, whatever the status; nothing may be left."""
    with launched(folder, what, options, **kwargs) as run:
        run.wait()
        assert not run.everything()
        return run
