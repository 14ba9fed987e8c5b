"""The life of one process as a pure function from state and event to state and effects.

    waiting ─ Start ─▶ starting ─ Started ─▶ running ─ Satisfied ─▶ ready
       │                  ▲ ▲                   └─┬─ Ended, Stop, Hung ─┘
       │        DelayOver │ └──────── Renew ─── stopping, where something is to end
       │             restarting ◀─ by policy ─────┤
       └─ Skip, Stop, Halt ─▶ skipped             ▼
                                           exited | failed

What has ended, or was skipped, begins anew with Start. An operator's Halt and Renew are no failures, whatever the
program makes of them; a Hung process has failed, whatever its exit code.

An event that means nothing in a state leaves it as it is: events cross on their way (a timer fires while the process
that it watched has just ended), so every pair is defined. Time comes in with the events.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from orchestra.fields import replace
from orchestra.supervise.process.backoff import decide
from orchestra.supervise.process.life import (
    KILL,
    POLITE,
    QUIESCE,
    TERMINATE,
    DelayOver,
    Effect,
    Ended,
    Escalated,
    Event,
    Gone,
    Guard,
    Halt,
    Hung,
    Missed,
    Pause,
    Phase,
    Quiesce,
    ReadyExpired,
    Renew,
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
    Unguard,
    Unstartable,
    Unwatch,
    Watch,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.process.ending import Ending
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
    sound = ending.reason is None and ending.hang is None
    return sound and ending.code is not None and ending.code in rules.success


def _start(_rules: Rules, state: State, _event: Start | DelayOver | Renew) -> Step:
    fresh = State(Phase.STARTING, state.starts, state.been_ready, state.started_at, state.short_runs)
    return fresh, (Spawn(),)


def _start_anew(rules: Rules, state: State, event: Start | Renew) -> Step:
    """Somebody decided it: what happened before counts no longer."""
    return _start(rules, replace(state, short_runs=0), event)


def _start_early(rules: Rules, state: State, event: Start | Renew) -> Step:
    fresh, effects = _start_anew(rules, state, event)
    return fresh, (Settle(), *effects)


def _skip(_rules: Rules, state: State, event: Skip | StopRequested | Halt) -> Step:
    return replace(state, phase=Phase.SKIPPED, halted=isinstance(event, Halt)), ()


def _started(rules: Rules, state: State, event: Started) -> Step:
    running = replace(state, phase=Phase.RUNNING, starts=state.starts + 1, started_at=event.now)
    if state.asked:
        return _descend(rules, running, POLITE)
    if rules.awaits_ready:
        return running, (Watch(rules.ready_timeout),)
    return replace(running, been_ready=True), (Guard(),) if rules.guarded else ()


def _unstartable(rules: Rules, state: State, event: Unstartable) -> Step:
    return _settle(rules, replace(state, started_at=event.now), event.ending, event.now)


def _satisfied(rules: Rules, state: State, _event: Satisfied) -> Step:
    if not rules.awaits_ready:
        return state, ()
    guard = (Guard(),) if rules.guarded else ()
    return replace(state, phase=Phase.READY, been_ready=True), (Unwatch(), *guard)


def _ready_expired(_rules: Rules, state: State, _event: ReadyExpired) -> Step:
    return state, (Unwatch(), Missed())


def _ended(rules: Rules, state: State, event: Ended) -> Step:
    relaxed = _relax(rules, state)
    if not event.remains:
        settled, effects = _settle(rules, state, event.ending, event.now)
        return settled, (*relaxed, *effects)
    left = replace(state, ending=event.ending, unasked=not state.asked)
    stopping, effects = _descend(rules, left, POLITE)
    return stopping, (*relaxed, *effects)


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


def _ask(_rules: Rules, state: State, event: StopAhead | StopRequested | Halt) -> Step:
    return replace(state, asked=True, again=False, halted=isinstance(event, Halt)), ()


def _stop(rules: Rules, state: State, event: StopRequested | Halt) -> Step:
    halted = isinstance(event, Halt)
    return _part(rules, replace(state, asked=True, again=False, halted=halted, ending=None))


def _stop_while_pausing(_rules: Rules, state: State, event: StopRequested | Halt) -> Step:
    return replace(state, phase=Phase.EXITED, asked=True, halted=isinstance(event, Halt)), (Settle(),)


def _renew(rules: Rules, state: State, _event: Renew) -> Step:
    return _part(rules, replace(state, asked=False, again=True, ending=None))


def _renew_when_gone(_rules: Rules, state: State, _event: Renew) -> Step:
    return replace(state, asked=False, again=True, halted=False), ()


def _hung(rules: Rules, state: State, event: Hung) -> Step:
    hanging = replace(state, hang=event.reason, unasked=not state.asked, ending=None)
    stopping, (first, *_) = _descend(rules, hanging, POLITE)
    if rules.aborts:
        first = Send("SIGABRT", POLITE, rules.stop.timeout)
    return stopping, (*_relax(rules, state), first)


def _part(rules: Rules, state: State) -> Step:
    """End a program that runs; one that is managed leaves its work first, unless it has not come to it yet."""
    relaxed = _relax(rules, state)
    if rules.managed and state.been_ready:
        quiet = replace(state, phase=Phase.STOPPING, rung=QUIESCE)
        return quiet, (*relaxed, Quiesce(rules.quiesce_within))
    stopping, effects = _descend(rules, state, POLITE)
    return stopping, (*relaxed, *effects)


def _relax(rules: Rules, state: State) -> tuple[Effect, ...]:
    """Return what is not to be looked out for any more when a program leaves its running phase."""
    if state.phase is Phase.RUNNING and rules.awaits_ready:
        return (Unwatch(),)
    return (Unguard(),) if rules.guarded else ()


def _rung_expired(rules: Rules, state: State, event: RungExpired) -> Step:
    if event.rung != state.rung or state.rung == KILL:
        return state, ()
    return _descend(rules, state, state.rung + 1)


def _escalated(rules: Rules, state: State, event: Escalated) -> Step:
    if event.rung <= state.rung:
        return state, ()
    return _descend(rules, state, event.rung)


def _descend(rules: Rules, state: State, rung: int) -> Step:
    return replace(state, phase=Phase.STOPPING, rung=rung), (ladder(rules.stop, rung),)


def _settle(rules: Rules, state: State, ending: Ending, now: float) -> Step:
    """Nothing is left of this run: decide what comes next."""
    ending = ending if state.hang is None else replace(ending, hang=state.hang)
    done = replace(state, ending=ending)
    success = succeeded(rules, ending)
    if state.asked:
        return replace(done, phase=Phase.FAILED if state.unasked and not success else Phase.EXITED), ()
    if state.again:
        return _start_anew(rules, done, Renew())
    again = decide(rules.restart, success=success, uptime=now - state.started_at, short_runs=state.short_runs)
    if again:
        paused = replace(done, phase=Phase.RESTARTING, short_runs=again.short_runs)
        return paused, (Pause(again.delay, again.jitter),)
    return replace(done, phase=Phase.EXITED if success else Phase.FAILED), ()


_TABLE: dict[tuple[Phase, type[Any]], Callable[..., Step]] = {
    (Phase.WAITING, Start): _start,
    (Phase.WAITING, Skip): _skip,
    (Phase.WAITING, StopRequested): _skip,
    (Phase.WAITING, Halt): _skip,
    (Phase.STARTING, Started): _started,
    (Phase.STARTING, Unstartable): _unstartable,
    (Phase.STARTING, StopAhead): _ask,
    (Phase.STARTING, StopRequested): _ask,
    (Phase.STARTING, Halt): _ask,
    (Phase.RUNNING, Satisfied): _satisfied,
    (Phase.RUNNING, ReadyExpired): _ready_expired,
    (Phase.RUNNING, Hung): _hung,
    (Phase.STOPPING, Ended): _ended_while_stopping,
    (Phase.STOPPING, Gone): _gone,
    (Phase.STOPPING, StopAhead): _ask,
    (Phase.STOPPING, StopRequested): _ask,
    (Phase.STOPPING, Halt): _ask,
    (Phase.STOPPING, Renew): _renew_when_gone,
    (Phase.STOPPING, RungExpired): _rung_expired,
    (Phase.STOPPING, Escalated): _escalated,
    (Phase.RESTARTING, DelayOver): _start,
    (Phase.RESTARTING, Start): _start_early,
    (Phase.RESTARTING, Renew): _start_early,
    (Phase.RESTARTING, StopRequested): _stop_while_pausing,
    (Phase.RESTARTING, Halt): _stop_while_pausing,
    (Phase.READY, Hung): _hung,
    **{
        (phase, event): handler
        for phase in (Phase.RUNNING, Phase.READY)
        for event, handler in (
            (Ended, _ended),
            (StopAhead, _ask),
            (StopRequested, _stop),
            (Halt, _stop),
            (Renew, _renew),
        )
    },
    **{
        (phase, event): _start_anew
        for phase in (Phase.EXITED, Phase.FAILED, Phase.SKIPPED)
        for event in (Start, Renew)
    },
}
