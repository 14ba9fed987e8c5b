"""Actions that follow events: the start of the run, or the end of a process."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from orchestra.plan.reactions import LogAction, StartAction

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from orchestra.plan.reactions import Trigger, TriggeredAction
    from orchestra.supervise.loop import Loop, Timer


def held(triggers: Iterable[Trigger]) -> frozenset[str]:
    """Return the processes that a trigger starts, which therefore do not start with the run."""
    return frozenset(
        action.process for trigger in triggers for action in trigger.do if isinstance(action, StartAction)
    )


class Triggers:
    """Waits for the events of triggers and hands their actions on when their delay is over."""

    def __init__(
        self,
        triggers: Iterable[Trigger],
        loop: Loop,
        fire: Callable[[Trigger], None],
    ) -> None:
        self._triggers = tuple(triggers)
        self._loop = loop
        self._fire = fire
        self._delayed: list[Timer] = []
        self._stopping = False

    @property
    def pending(self) -> bool:
        """Whether an event has happened whose actions are still to come."""
        self._delayed = [timer for timer in self._delayed if not timer.cancelled]
        return bool(self._delayed)

    def run_started(self) -> None:
        """The run has started."""
        self._happened("run_started", None)

    def process_ended(self, process: str) -> None:
        """One run of a process is over."""
        self._happened("process_exited", process)

    def stop(self) -> None:
        """The run is ending: drop what is still to come; from now on only what has no delay happens."""
        self._stopping = True
        for timer in self._delayed:
            timer.cancel()

    def _happened(self, event: str, process: str | None) -> None:
        for trigger in self._triggers:
            if trigger.delay and self._stopping:
                continue
            if trigger.on.event == event and trigger.on.target in (None, process):
                self._delayed.append(
                    self._loop.call_later(trigger.delay or 0.0, partial(self._fire, trigger))
                )


def actions_while_stopping(actions: Iterable[TriggeredAction]) -> tuple[TriggeredAction, ...]:
    """Return what may still be done when the run is ending: nothing starts any more, and one end is enough."""
    return tuple(action for action in actions if isinstance(action, LogAction))
