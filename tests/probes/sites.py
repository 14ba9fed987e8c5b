"""A place where probes work: a real loop, real programs, and what they were given is counted."""

from __future__ import annotations

import contextlib
import os
import time
from functools import partial
from typing import TYPE_CHECKING

from orchestra.probes.protocol import Site
from orchestra.supervise.keeping.kin import Kin
from orchestra.supervise.loop import Loop
from orchestra.supervise.process.spec import Spec
from orchestra.supervise.signs.trial import Trials

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from orchestra.probes.protocol import Cancel, Probe, Request, Result

PATIENCE = 60.0


class Place:
    """One site, and the wait of one probe there."""

    def __init__(self, folder: str | None, environment: dict[str, str] | None = None) -> None:
        self.loop = Loop()
        self.kin = Kin("a run")
        self.trials = Trials(self.loop, self.kin)
        self.environment = dict(os.environ) if environment is None else environment
        self.impossible: list[str] = []
        self.came = 0
        self.site = Site(
            loop=self.loop,
            folder=folder,
            run=partial(self._run, folder),
            watch=_nobody_watches,
            on_output=lambda _heard: None,
            on_notice=lambda _variable, _heard: None,
            impossible=self.impossible.append,
        )

    def _run(
        self, folder: str | None, command: Sequence[str], limit: float, told: Callable[[Result], None]
    ) -> Cancel:
        spec = Spec("trial", tuple(command), self.environment, folder, tty=False, stdin=False)
        return self.trials.run(spec, limit, told)

    @property
    def idle(self) -> bool:
        """Whether nothing is waited for: no descriptor, no timer, no program."""
        return not self.loop._watched and self.loop._until_next_timer() is None and not self.trials.alive

    def begin(self, probe: Probe) -> None:
        probe.begin(self.site, self._count)

    def until(self, condition: Callable[[], object], what: str) -> None:
        """Go on until something holds."""
        deadline = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < deadline, what
            timer = self.loop.call_later(0.05, lambda: None)
            self.loop.run_once()
            timer.cancel()

    def holds(self, probe: Probe) -> None:
        """Wait until the probe has come about; nothing is waited for any more then."""
        self.until(lambda: self.came, f"{probe.words} did not come about")
        assert self.came == 1
        self.until(lambda: self.idle, f"{probe.words} left something behind")

    def fails(self, probe: Probe, words: str) -> None:
        """Wait until the probe says why it does not hold; it gives back everything when nobody waits any more."""
        self.until(lambda: probe.words == words, f"{probe.words} instead of {words}")
        assert not self.came
        probe.end()
        self.until(lambda: self.idle, f"{probe.words} left something behind")
        assert not self.came

    def _count(self) -> None:
        self.came += 1


def _nobody_watches(_request: Request, _answer: Callable[[str | None], None]) -> Cancel:
    raise AssertionError("no observer is here")


@contextlib.contextmanager
def place(folder: object = None, environment: dict[str, str] | None = None) -> Iterator[Place]:
    """Open a place; nothing may be left of its programs."""
    opened = Place(None if folder is None else str(folder), environment)
    try:
        yield opened
    finally:
        opened.until(lambda: not opened.trials.alive, "programs are left")
        opened.loop.close()
