"""Carries out what triggers do: the actions of one event one after another, and what is asked for in between.

An action that only code of the description knows holds up what follows in its own sequence, and nothing else.
"""

from __future__ import annotations

from collections import deque
from functools import partial
from typing import TYPE_CHECKING, Protocol

from orchestra.plan.reactions import (
    CancelAction,
    DeferredAction,
    LogAction,
    RegisterAction,
    StartAction,
    Trigger,
    UnregisterAction,
)
from orchestra.supervise.reactions.happening import question

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.location import Location
    from orchestra.plan.reactions import TriggeredAction
    from orchestra.supervise.reactions.fragment import Failure, Fragment
    from orchestra.supervise.reactions.happening import Happening
    from orchestra.supervise.reactions.questions import Questions
    from orchestra.supervise.surroundings import Surroundings


class Stage(Protocol):
    """The running system, as far as actions can change it."""

    @property
    def ending(self) -> bool:
        """Whether the run is coming to its end."""

    def carry_out(self, action: TriggeredAction) -> None:
        """Do something other than to tell, or to ask."""

    def revise(self, fragment: Fragment, trigger: Trigger) -> str | None:
        """Take up what a trigger adds to the plan; return why that is impossible, if it is."""

    def trigger_failed(self, reason: str) -> None:
        """A trigger could not do what it should."""


class _Sequence:
    """What is still to be done about an event; a trigger in it stands for the begin of its actions."""

    __slots__ = ("happening", "todo", "trigger")

    def __init__(self, happening: Happening, triggers: Sequence[Trigger]) -> None:
        self.happening = happening
        self.todo: deque[Trigger | TriggeredAction] = deque(triggers)
        self.trigger = triggers[0]


class Performance:
    """Performs sequences of actions. What cannot be answered in time is told by the questions themselves."""

    def __init__(self, stage: Stage, questions: Questions, surroundings: Surroundings) -> None:
        self._stage = stage
        self._questions = questions
        self._around = surroundings
        self._dropped: dict[Location, int] = {}

    def begin(self, happening: Happening, triggers: Sequence[Trigger]) -> None:
        """Do what the triggers say, one after another."""
        self._go_on(_Sequence(happening, triggers))

    def _go_on(self, sequence: _Sequence) -> None:
        while sequence.todo:
            action = sequence.todo.popleft()
            if isinstance(action, Trigger):
                self._fired(sequence, action)
            elif isinstance(action, DeferredAction):
                self._ask(sequence, action)
                return
            else:
                self._perform(action)

    def _fired(self, sequence: _Sequence, trigger: Trigger) -> None:
        names = [action.action for action in trigger.do]
        self._around.recorder.record(
            "trigger_fired", sequence.happening.target, trigger=trigger.id, on=trigger.on.event, do=names
        )
        sequence.trigger = trigger
        sequence.todo.extendleft(reversed(trigger.do))

    def _perform(self, action: TriggeredAction) -> None:
        if isinstance(action, LogAction):
            self._tell(action)
        elif not self._stage.ending or isinstance(action, RegisterAction | UnregisterAction | CancelAction):
            self._stage.carry_out(action)
        elif isinstance(action, StartAction):
            self._around.journal.say(f"{action.process} is not started: the run is ending")

    def _tell(self, action: LogAction) -> None:
        if action.level == "debug" and not self._around.options.debug:
            self._around.journal.note(f"debug: {action.message}")
        else:
            prefix = "" if action.level == "info" else f"{action.level}: "
            self._around.journal.say(prefix + action.message)

    def _ask(self, sequence: _Sequence, action: DeferredAction) -> None:
        happening = sequence.happening
        taken = self._questions.ask(
            question(action.ref, happening),
            partial(self._answered, sequence, action),
            droppable=happening.frequent,
        )
        if not taken:
            self._drop(action.location)

    def _drop(self, location: Location) -> None:
        self._dropped[location] = self._dropped.get(location, 0) + 1
        if self._dropped[location] == 1:
            self._around.journal.say(
                f"{location}: output comes faster than this handler takes it; some of it is not given to it"
            )

    def _answered(self, sequence: _Sequence, action: DeferredAction, answer: Fragment | Failure) -> None:
        from orchestra.supervise.reactions.fragment import Failure  # noqa: PLC0415 - few plans have such triggers

        if isinstance(answer, Failure):
            self._fail(answer.location or action.location, answer)
            return
        for problem in answer.problems:
            self._around.journal.say(
                f"{problem.span or action.location}: {problem.severity}: {problem.message}"
            )
        fault = self._stage.revise(answer, sequence.trigger)
        if fault:
            self._fail(action.location, Failure(fault))
            return
        sequence.todo.extendleft(reversed(answer.do))
        self._go_on(sequence)

    def _fail(self, location: Location, failure: Failure) -> None:
        if failure.abandoned:
            self._around.journal.say(f"{location}: this trigger is given up: {failure.reason}")
        else:
            self._stage.trigger_failed(f"{location}: this trigger failed: {failure.reason}")
