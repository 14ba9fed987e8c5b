"""A launched system, as a test sees it."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import time
from contextlib import suppress
from typing import TYPE_CHECKING, NoReturn, Self, TypeVar

from orchestra.logs.names import log_stems
from orchestra.plan import codec
from orchestra.testing.readiness import identity, standing
from orchestra.testing.survivors import Survivor, survivors

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from orchestra.events import Event, Kind
    from orchestra.plan.model import Plan
    from orchestra.testing.stream import EventStream

_Result = TypeVar("_Result")

DEADLINE = 30.0  # seconds; generous, for a loaded machine
_LOOK_AGAIN = 0.02
_TAIL = 40


class Run:
    """A system that `orchestra launch` has started and this test ends.

    All waiting has a deadline in seconds. Where it passes, or the run ends before, an `AssertionError` tells what was
    awaited and shows the end of the output.
    """

    def __init__(
        self,
        process: subprocess.Popen[bytes],
        stream: EventStream,
        output: Path,
        environment: dict[str, str],
    ) -> None:
        self.environment = environment
        self._process = process
        self._stream = stream
        self._output = output
        self._plan: Plan | None = None
        self._status_seen = False

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_error: object) -> None:
        self.finish()

    @property
    def domain(self) -> int:
        """The ROS domain of the run; a program that is started with `environment` hears it."""
        return int(self.environment["ROS_DOMAIN_ID"])

    @property
    def pid(self) -> int:
        """The process id of `orchestra launch`."""
        return self._process.pid

    @property
    def output(self) -> str:
        """All that the run has written to the screen so far."""
        return self._output.read_text("utf-8", errors="replace")

    @property
    def events(self) -> tuple[Event, ...]:
        """All that has happened so far."""
        return self._stream.events()

    @property
    def directory(self) -> Path:
        """The run directory; waits for the run to begin."""
        return self._until(lambda: self._stream.path, "the beginning of the run", DEADLINE).parent

    @property
    def plan(self) -> Plan:
        """The plan that is carried out; waits for the run to begin."""
        if self._plan is None:
            self.wait_for_event("run_started")
            self._plan = codec.loads((self.directory / "plan.json").read_bytes())
        return self._plan

    def wait_ready(self, *names: str, timeout: float = DEADLINE) -> None:
        """Wait until the named processes are up, or all that start with the run.

        A process with a `ready` condition is up when it has been met, any other when its program runs.
        """
        plan = self.plan

        def up() -> bool | None:
            now = standing(plan, self.events, names)
            if now.lost:
                self._fail("; ".join(now.lost))
            return None if now.pending else True

        self._until(up, f"readiness of {', '.join(names) or 'all processes'}", timeout)

    def wait_for_event(self, kind: Kind, process: str | None = None, *, timeout: float = DEADLINE) -> Event:
        """Wait for an event of a kind, of one process where it is named; return the first."""
        target = None if process is None else identity(self.plan, process)

        def found() -> Event | None:
            events = (event for event in self.events if event.kind == kind)
            return next((event for event in events if target is None or event.process == target), None)

        return self._until(found, f"the event {kind}{f' of {target}' if target else ''}", timeout)

    def logs(self, name: str) -> str:
        """Return all that a process has written so far."""
        stems = log_stems(process.id for process in self.plan.processes)
        path = self.directory / "logs" / f"{stems[identity(self.plan, name)]}.log"
        try:
            return path.read_text("utf-8", errors="replace")
        except FileNotFoundError:
            return ""  # it has not written anything

    def wait_for_log(
        self, pattern: str, process: str | None = None, *, timeout: float = DEADLINE
    ) -> re.Match[str]:
        """Wait until the output of a process, or of any, matches a regular expression; return the first match.

        `^` and `$` match at the ends of lines.
        """
        expression = re.compile(pattern, re.MULTILINE)
        names = [process] if process else [known.id for known in self.plan.processes]

        def found() -> re.Match[str] | None:
            matches = (expression.search(self.logs(name)) for name in names)
            return next((match for match in matches if match), None)

        return self._until(
            found, f"output{f' of {process}' if process else ''} that matches {pattern!r}", timeout
        )

    def wait(self, timeout: float = DEADLINE) -> int:
        """Wait until the run has ended by itself; return its exit status."""
        try:
            status = self._process.wait(timeout)
        except subprocess.TimeoutExpired:
            self._fail(f"the run has not ended within {timeout:g} s")
        self._status_seen = True
        return status

    def stop(self, timeout: float = DEADLINE) -> int:
        """End the run as Ctrl-C does, unless it has ended; return its exit status."""
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
        return self.wait(timeout)

    def survivors(self) -> tuple[Survivor, ...]:
        """Return the processes of the run that are still there."""
        started = next((event for event in self.events if event.kind == "run_started"), None)
        return survivors(started.data["run"]) if started else ()

    def finish(self) -> None:
        """End the run and see that it ended well: it went as the test knows, and nothing is left of it.

        What is left is killed, so that it disturbs no other test, and is an `AssertionError` all the same.
        """
        running = self._process.poll() is None
        known = self._status_seen
        try:
            status = self.stop()
        finally:
            left = self._kill_all()
        if left:
            self._fail(f"the run has left something behind: {'; '.join(map(str, left))}")
        if not known and status not in ((0, 128 + signal.SIGINT) if running else (0,)):
            self._fail(f"the run {'was stopped' if running else 'ended by itself'} with status {status}")

    def _kill_all(self) -> tuple[Survivor, ...]:
        if self._process.poll() is None:
            self._process.kill()
            self._process.wait()
        left = self.survivors()
        for survivor in left:
            with suppress(ProcessLookupError):
                os.kill(survivor.pid, signal.SIGKILL)
        return left

    def _until(self, condition: Callable[[], _Result | None], awaited: str, timeout: float) -> _Result:
        deadline = time.monotonic() + timeout
        while True:
            ended = (
                self._process.poll()
            )  # before the condition, which sees everything that came before the end
            result = condition()
            if result is not None:
                return result
            if ended is not None:
                self._fail(f"the run ended with status {ended} before {awaited}")
            if time.monotonic() > deadline:
                self._fail(f"waited {timeout:g} s in vain for {awaited}")
            time.sleep(_LOOK_AGAIN)

    def _fail(self, what: str) -> NoReturn:
        tail = "\n".join(self.output.splitlines()[-_TAIL:])
        raise AssertionError(f"{what}\nthe end of the output:\n{tail}")
