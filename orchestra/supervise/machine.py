"""The life of one process as a pure function from state and event to state and effects.

    waiting ─ Start ─▶ starting ─ Started ─▶ running ─ Satisfied ─▶ ready
                          ▲                     └──────── Ended ──────┘
                          │ DelayOver                       │ something is left: stopping
                      restarting ◀── by policy ─────────────┤
                                                            ▼
    waiting ─ Skip, Stop ─▶ skipped                exited | failed

An event that means nothing in a state leaves it as it is: events cross on their way (a timer fires while the process
that it watched has just ended), so every pair is defined. Time comes in with the events.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeAlias

from orchestra.supervise.backoff import decide
from orchestra.supervise.life import (
    KILL,
    POLITE,
    TERMINATE,
    DelayOver,
    Effect,
    Ended,
    Escalated,
    Event,
    Gone,
    Missed,
    Pause,
    Phase,
    ReadyExpired,
    Rules,
    RungExpired,
    Satisfied,
    Send,
    Settle,
    Skip,
    Spawn,
    Start,
    Started,
    State,
    StopAhead,
    StopRequested,
    Unstartable,
    Unwatch,
    Watch,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.ending import Ending
    from orchestra.values import Stop

Step: TypeAlias = tuple[State, tuple[Effect, ...]]


def transition(rules: Rules, state: State, event: Event) -> Step:
    """Return the state after an event, and what is to be done."""
    handler = _TABLE.get((state.phase, type(event)))
    return handler(rules, state, event) if handler else (state, ())


def ladder(stop: Stop, rung: int) -> Send:
    """Return a step of the stop ladder."""
    steps = (
        Send(stop.signal, POLITE, stop.timeout),
        Send("SIGTERM", TERMINATE, stop.kill_timeout),
        Send("SIGKILL", KILL, None),
    )
    return steps[rung]


def succeeded(rules: Rules, ending: Ending) -> bool:
    """Tell whether a program ended as it should."""
    return ending.reason is None and ending.code is not None and ending.code in rules.success


def _start(_rules: Rules, state: State, _event: Start) -> Step:
    return replace(state, phase=Phase.STARTING, asked=False, unasked=False, ending=None), (Spawn(),)


def _skip(_rules: Rules, state: State, _event: Skip | StopRequested) -> Step:
    return replace(state, phase=Phase.SKIPPED), ()


def _started(rules: Rules, state: State, event: Started) -> Step:
    running = replace(state, phase=Phase.RUNNING, starts=state.starts + 1, started_at=event.now)
    if state.asked:
        return _descend(rules, running, POLITE)
    if rules.awaits_ready:
        return running, (Watch(rules.ready_timeout),)
    return replace(running, been_ready=True), ()


def _unstartable(rules: Rules, state: State, event: Unstartable) -> Step:
    return _settle(rules, replace(state, started_at=event.now), event.ending, event.now)


def _satisfied(rules: Rules, state: State, _event: Satisfied) -> Step:
    if not rules.awaits_ready:
        return state, ()
    return replace(state, phase=Phase.READY, been_ready=True), (Unwatch(),)


def _ready_expired(_rules: Rules, state: State, _event: ReadyExpired) -> Step:
    return state, (Unwatch(), Missed())


def _ended(rules: Rules, state: State, event: Ended) -> Step:
    unwatch = (Unwatch(),) if state.phase is Phase.RUNNING and rules.awaits_ready else ()
    if not event.remains:
        settled, effects = _settle(rules, state, event.ending, event.now)
        return settled, (*unwatch, *effects)
    stopping, effects = _descend(rules, replace(state, ending=event.ending, unasked=not state.asked), POLITE)
    return stopping, (*unwatch, *effects)


def _ended_while_stopping(rules: Rules, state: State, event: Ended) -> Step:
    if event.remains:
        return replace(state, ending=event.ending), ()
    settled, effects = _settle(rules, state, event.ending, event.now)
    return settled, (Settle(), *effects)


def _gone(rules: Rules, state: State, event: Gone) -> Step:
    if state.ending is None:
        return state, ()
    settled, effects = _settle(rules, state, state.ending, event.now)
    return settled, (Settle(), *effects)


def _ask(_rules: Rules, state: State, _event: StopAhead | StopRequested) -> Step:
    return replace(state, asked=True), ()


def _stop(rules: Rules, state: State, _event: StopRequested) -> Step:
    unwatch = (Unwatch(),) if state.phase is Phase.RUNNING and rules.awaits_ready else ()
    stopping, effects = _descend(rules, replace(state, asked=True, ending=None), POLITE)
    return stopping, (*unwatch, *effects)


def _stop_while_pausing(_rules: Rules, state: State, _event: StopRequested) -> Step:
    return replace(state, phase=Phase.EXITED, asked=True), (Settle(),)


def _rung_expired(rules: Rules, state: State, event: RungExpired) -> Step:
    if event.rung != state.rung or state.rung == KILL:
        return state, ()
    return _descend(rules, state, state.rung + 1)


def _escalated(rules: Rules, state: State, event: Escalated) -> Step:
    if event.rung <= state.rung:
        return state, ()
    return _descend(rules, state, event.rung)


def _delay_over(_rules: Rules, state: State, _event: DelayOver) -> Step:
    return replace(state, phase=Phase.STARTING, unasked=False, ending=None), (Spawn(),)


def _descend(rules: Rules, state: State, rung: int) -> Step:
    return replace(state, phase=Phase.STOPPING, rung=rung), (ladder(rules.stop, rung),)


def _settle(rules: Rules, state: State, ending: Ending, now: float) -> Step:
    """Nothing is left of this run: decide what comes next."""
    done = replace(state, ending=ending)
    success = succeeded(rules, ending)
    if state.asked:
        return replace(done, phase=Phase.FAILED if state.unasked and not success else Phase.EXITED), ()
    again = decide(rules.restart, success=success, uptime=now - state.started_at, short_runs=state.short_runs)
    if again:
        paused = replace(done, phase=Phase.RESTARTING, short_runs=again.short_runs)
        return paused, (Pause(again.delay),)
    return replace(done, phase=Phase.EXITED if success else Phase.FAILED), ()


_TABLE: dict[tuple[Phase, type[Any]], Callable[..., Step]] = {
    (Phase.WAITING, Start): _start,
    (Phase.WAITING, Skip): _skip,
    (Phase.WAITING, StopRequested): _skip,
    (Phase.STARTING, Started): _started,
    (Phase.STARTING, Unstartable): _unstartable,
    (Phase.STARTING, StopAhead): _ask,
    (Phase.STARTING, StopRequested): _ask,
    (Phase.RUNNING, Satisfied): _satisfied,
    (Phase.RUNNING, ReadyExpired): _ready_expired,
    (Phase.RUNNING, Ended): _ended,
    (Phase.RUNNING, StopAhead): _ask,
    (Phase.RUNNING, StopRequested): _stop,
    (Phase.READY, Ended): _ended,
    (Phase.READY, StopAhead): _ask,
    (Phase.READY, StopRequested): _stop,
    (Phase.STOPPING, Ended): _ended_while_stopping,
    (Phase.STOPPING, Gone): _gone,
    (Phase.STOPPING, StopAhead): _ask,
    (Phase.STOPPING, StopRequested): _ask,
    (Phase.STOPPING, RungExpired): _rung_expired,
    (Phase.STOPPING, Escalated): _escalated,
    (Phase.RESTARTING, DelayOver): _delay_over,
    (Phase.RESTARTING, StopRequested): _stop_while_pausing,
    (Phase.EXITED, Start): _start,
    (Phase.FAILED, Start): _start,
}
