"""Which triggers wait for what, and which are set off; what they do is the business of `performance`."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from orchestra.plan.reactions import StartAction
from orchestra.supervise.reactions.happening import in_order, run_started
from orchestra.supervise.reactions.waiting import Waiting

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from orchestra.plan.reactions import Trigger, TriggeredAction
    from orchestra.supervise.loop import Loop, Timer
    from orchestra.supervise.reactions.happening import Happening
    from orchestra.values import EventName

# While the run ends, a delay that is not dropped is awaited for so long, in seconds: everything is gone soon after.
LONGEST_AT_THE_END = 3.0


def held(triggers: Iterable[Trigger], do: Iterable[TriggeredAction] = ()) -> frozenset[str]:
    """Return the processes that an action starts, which therefore do not start with the run."""
    actions = [*(action for trigger in triggers for action in trigger.do), *do]
    return frozenset(action.process for action in actions if isinstance(action, StartAction))


class Triggers:
    """Waits for the events of triggers and hands those that are set off on when their delay is over.

    `fire` gets what happened and the triggers that belong together: those of one event without a delay.
    """

    def __init__(self, loop: Loop, fire: Callable[[Happening, Sequence[Trigger]], None]) -> None:
        self._loop = loop
        self._fire = fire
        self._known: dict[str, Trigger] = {}
        self._waiting = Waiting()
        self._delayed: dict[int, tuple[Timer, Trigger]] = {}  # in the order in which they were set off
        self._set_off_so_far = 0
        self._started = False
        self._stopping = False

    @property
    def pending(self) -> bool:
        """Whether an event has happened whose actions are still to come."""
        return bool(self._delayed)

    def add(self, triggers: Iterable[Trigger]) -> None:
        """Take up more triggers; those that are armed wait from now on."""
        for trigger in triggers:
            self._known[trigger.id] = trigger
            if trigger.armed:
                self._wait(trigger)

    def register(self, name: str) -> None:
        """Let a trigger wait for its event; as the latest, whether or not it did before."""
        self._wait(self._known[name])

    def _wait(self, trigger: Trigger) -> None:
        """Let a trigger wait; what it waits for has come if that is the start of the run, which it was added to."""
        self._waiting.add(trigger)
        if self._started and trigger.on.event == "run_started":
            self._set_off([trigger], run_started())

    def unregister(self, name: str) -> None:
        """Let a trigger wait no more."""
        self._waiting.remove(name)

    def cancel(self, name: str) -> None:
        """Let a trigger wait no more, and drop what its delay puts off."""
        self.unregister(name)
        for number, (_, trigger) in [*self._delayed.items()]:
            if trigger.id == name and trigger.delay:
                self._drop(number)

    def awaits(self, event: EventName) -> bool:
        """Tell whether a trigger waits for events of a kind, or has waited."""
        return self._waiting.has(event)

    def may_wait(self, event: EventName) -> list[Trigger]:
        """Return the triggers on events of a kind, also those that do not wait yet."""
        return [trigger for trigger in self._known.values() if trigger.on.event == event]

    def happened(self, happening: Happening) -> None:
        """Set off what waits for this."""
        self._started = self._started or happening.event == "run_started"
        waiting = self._waiting.about(happening)
        if waiting:
            self._set_off(in_order(waiting, happening), happening)

    def _set_off(self, triggers: Iterable[Trigger], happening: Happening) -> None:
        at_once = []
        for trigger in triggers:
            if trigger.once:
                self.unregister(trigger.id)
            if not trigger.delay:
                at_once.append(trigger)
            elif not self._stopping or self._still_happens(trigger, trigger.delay):
                self._later(trigger.delay, happening, [trigger])
        if at_once:
            self._later(0.0, happening, at_once)

    def stop(self) -> list[Trigger]:
        """The run is ending: drop what is delayed unless it says otherwise; return what says so, but is too late."""
        self._stopping = True
        lost = []
        for number, (timer, trigger) in [*self._delayed.items()]:
            remaining = timer.due - self._loop.clock()
            if not trigger.delay or self._still_happens(trigger, remaining):
                continue
            self._drop(number)
            if not trigger.cancel_on_shutdown:
                lost.append(trigger)
        return lost

    def _still_happens(self, trigger: Trigger, remaining: float) -> bool:
        return not trigger.cancel_on_shutdown and remaining <= LONGEST_AT_THE_END

    def _later(self, delay: float, happening: Happening, triggers: Sequence[Trigger]) -> None:
        number = self._set_off_so_far = self._set_off_so_far + 1
        timer = self._loop.call_later(delay, partial(self._come, number, happening, triggers))
        self._delayed[number] = (timer, triggers[0])

    def _come(self, number: int, happening: Happening, triggers: Sequence[Trigger]) -> None:
        """Hand on what was put off."""
        del self._delayed[number]
        self._fire(happening, triggers)

    def _drop(self, number: int) -> None:
        """Forget what is put off."""
        timer, _ = self._delayed.pop(number)
        timer.cancel()
