"""What a run is doing, told on SIGQUIT: its state, its timers, and where our processes are in their code.

No process of the plan is signalled, and the run goes on.
"""

from __future__ import annotations

import os
import signal
import time
from typing import TYPE_CHECKING

from orchestra.supervise.keeping import proc
from orchestra.supervise.keeping.stacks import QUIET

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from orchestra.supervise.keeping.stacks import Stacks
    from orchestra.supervise.loop import Loop, Timer

# A resolver that can run begins to write within this time, in seconds.
_PATIENCE = 1.0
_OURS = "supervisor"


class Dump:
    """Tells the state of the run when asked.

    `report` gives what runs and what is waited for, `resolver` the pid of the resolver while there is one, `say` tells
    it to the user; the run directory keeps it too as soon as there is one, in `dump.txt`. All three change as the run
    goes on.
    """

    def __init__(self, loop: Loop, stacks: Stacks, say: Callable[[str], None]) -> None:
        self.report: Callable[[], str] = lambda: ""
        self.resolver: Callable[[], int | None] = lambda: None
        self.say = say
        self.folder: Path | None = None
        self._loop = loop
        self._stacks = stacks
        self._began = loop.clock()
        self._parts: list[str] = []
        self._asked: int | None = None
        self._answer = ""
        self._timer: Timer | None = None

    def take(self) -> None:
        """Begin a dump; it is told when the resolver has answered, if there is one."""
        if self._timer:
            return  # it answers both
        age = self._loop.clock() - self._began
        self._parts = [f"state of the run after {age:.1f} s", self.report().rstrip(), self._timers()]
        self._parts.append(self._our_stacks())
        self._asked = self.resolver()
        if self._asked is None:
            self._tell()
            return
        os.kill(self._asked, signal.SIGQUIT)
        self._loop.on_readable(self._stacks.descriptor, self._answered)
        self._answer = ""
        self._timer = self._loop.call_later(_PATIENCE, self._finish)

    def _our_stacks(self) -> str:
        """Return what keeper and supervisor wrote, each when the signal came to it."""
        written = self._stacks.read().rstrip()
        title = f"{_OURS} (pid {os.getpid()}):"
        return written if title in written else f"{title}\n{written}"

    def _timers(self) -> str:
        due = self._loop.pending()
        return (
            "\n".join(["timers:", *(f"  in {seconds:.1f} s {name}" for seconds, name in due)]) if due else ""
        )

    def _answered(self) -> None:
        """Take what has come, and wait for more of it."""
        self._answer += self._stacks.read()
        if self._timer:
            self._timer.cancel()
        self._timer = self._loop.call_later(QUIET, self._finish)

    def _finish(self) -> None:
        self._timer = None
        self._loop.forget(self._stacks.descriptor)
        self._parts.append(f"resolver (pid {self._asked}):{self._of_resolver()}")
        self._tell()

    def _of_resolver(self) -> str:
        if self._answer:
            return f"\n{self._answer.rstrip()}"
        facts = proc.stat(self._asked or 0)
        return " it does not answer" + (f"; its state is {facts.state}" if facts else "")

    def _tell(self) -> None:
        text = "\n".join(part for part in self._parts if part)
        self.say(text)
        if self.folder:
            try:
                self._keep(self.folder / "dump.txt", text)
            except OSError as error:
                self.say(f"the state of the run could not be kept: {error}")

    def _keep(self, path: Path, text: str) -> None:
        with path.open("a", encoding="utf-8", errors="replace") as file:
            file.write(f"{time.strftime('%Y-%m-%d %H:%M:%S')} {text}\n\n")
