from __future__ import annotations

import itertools
from dataclasses import replace
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.supervise.process import life
from orchestra.supervise.process.ending import Ending
from orchestra.supervise.process.life import (
    FINAL,
    KILL,
    LIVE,
    POLITE,
    QUIESCE,
    TERMINATE,
    Phase,
    Rules,
    State,
)
from orchestra.supervise.process.machine import _TABLE, transition
from orchestra.values import Restart, Stop

if TYPE_CHECKING:
    from orchestra.supervise.process.life import Effect, Event

PLAIN = Rules()
AWAITED = Rules(awaits_ready=True, ready_timeout=5.0)
RESPAWNED = Rules(restart=Restart("always", delay=3.0))
GUARDED = Rules(guarded=True)
ABORTED = Rules(guarded=True, aborts=True, awaits_ready=True, ready_timeout=5.0)
MANAGED = Rules(managed=True)
PATIENT = Rules(managed=True, quiesce_within=20.0)
GOOD, BAD = Ending(code=0), Ending(code=3)
LOST = Ending(code=127, reason="no such file")

ASK = life.Send("SIGINT", POLITE, 2.0)
TERM = life.Send("SIGTERM", TERMINATE, 1.5)
KILLED = life.Send("SIGKILL", KILL, None)

W, S, U, R = Phase.WAITING, Phase.STARTING, Phase.RUNNING, Phase.READY
O, A, X, F, K = Phase.STOPPING, Phase.RESTARTING, Phase.EXITED, Phase.FAILED, Phase.SKIPPED  # noqa: E741

# phase, what the state holds besides, rules, event, next phase, effects: every transition that there is.
TRANSITIONS: list[tuple[Phase, dict[str, object], Rules, Event, Phase, tuple[Effect, ...]]] = [
    (W, {}, PLAIN, life.Start(), S, (life.Spawn(),)),
    (W, {}, PLAIN, life.Skip(), K, ()),
    (W, {}, PLAIN, life.StopRequested(), K, ()),
    (S, {}, PLAIN, life.Started(9.0), U, ()),
    (S, {}, AWAITED, life.Started(9.0), U, (life.Watch(5.0),)),
    (S, {"asked": True}, AWAITED, life.Started(9.0), O, (ASK,)),
    (S, {}, PLAIN, life.Unstartable(LOST, 9.0), F, ()),
    (S, {}, RESPAWNED, life.Unstartable(LOST, 9.0), A, (life.Pause(3.0),)),
    (S, {"asked": True}, RESPAWNED, life.Unstartable(LOST, 9.0), X, ()),
    (S, {}, PLAIN, life.StopRequested(), S, ()),
    (S, {}, PLAIN, life.StopAhead(), S, ()),
    (U, {}, AWAITED, life.Satisfied(), R, (life.Unwatch(),)),
    (U, {}, PLAIN, life.Satisfied(), U, ()),
    (U, {}, AWAITED, life.ReadyExpired(), U, (life.Unwatch(), life.Missed())),
    (U, {}, PLAIN, life.Ended(GOOD, remains=False, now=9.0), X, ()),
    (U, {}, PLAIN, life.Ended(BAD, remains=False, now=9.0), F, ()),
    (U, {"asked": True}, PLAIN, life.Ended(BAD, remains=False, now=9.0), X, ()),
    (U, {}, AWAITED, life.Ended(BAD, remains=False, now=9.0), F, (life.Unwatch(),)),
    (U, {}, RESPAWNED, life.Ended(GOOD, remains=False, now=9.0), A, (life.Pause(3.0),)),
    (U, {"asked": True}, RESPAWNED, life.Ended(BAD, remains=False, now=9.0), X, ()),
    (U, {}, PLAIN, life.Ended(BAD, remains=True, now=9.0), O, (ASK,)),
    (U, {}, AWAITED, life.Ended(BAD, remains=True, now=9.0), O, (life.Unwatch(), ASK)),
    (U, {}, PLAIN, life.StopRequested(), O, (ASK,)),
    (U, {}, AWAITED, life.StopRequested(), O, (life.Unwatch(), ASK)),
    (U, {}, PLAIN, life.StopAhead(), U, ()),
    (R, {}, AWAITED, life.Ended(GOOD, remains=False, now=9.0), X, ()),
    (R, {}, AWAITED, life.Ended(BAD, remains=True, now=9.0), O, (ASK,)),
    (R, {}, AWAITED, life.StopRequested(), O, (ASK,)),
    (R, {}, AWAITED, life.StopAhead(), R, ()),
    (O, {"asked": True}, PLAIN, life.Ended(BAD, remains=False, now=9.0), X, (life.Settle(),)),
    (O, {"asked": True}, PLAIN, life.Ended(BAD, remains=True, now=9.0), O, ()),
    (O, {"asked": True, "ending": BAD}, PLAIN, life.Gone(9.0), X, (life.Settle(),)),
    (O, {"asked": True}, PLAIN, life.Gone(9.0), O, ()),
    (O, {"ending": BAD, "unasked": True}, PLAIN, life.Gone(9.0), F, (life.Settle(),)),
    (O, {"ending": GOOD, "unasked": True}, PLAIN, life.Gone(9.0), X, (life.Settle(),)),
    (O, {"ending": BAD, "unasked": True, "asked": True}, PLAIN, life.Gone(9.0), F, (life.Settle(),)),
    (O, {"ending": BAD, "unasked": True}, RESPAWNED, life.Gone(9.0), A, (life.Settle(), life.Pause(3.0))),
    (O, {"ending": BAD, "unasked": True}, PLAIN, life.StopRequested(), O, ()),
    (O, {}, PLAIN, life.StopAhead(), O, ()),
    (O, {"rung": POLITE}, PLAIN, life.RungExpired(POLITE), O, (TERM,)),
    (O, {"rung": TERMINATE}, PLAIN, life.RungExpired(TERMINATE), O, (KILLED,)),
    (O, {"rung": TERMINATE}, PLAIN, life.RungExpired(POLITE), O, ()),
    (O, {"rung": KILL}, PLAIN, life.RungExpired(KILL), O, ()),
    (O, {"rung": POLITE}, PLAIN, life.Escalated(KILL), O, (KILLED,)),
    (O, {"rung": TERMINATE}, PLAIN, life.Escalated(TERMINATE), O, ()),
    (A, {}, RESPAWNED, life.DelayOver(), S, (life.Spawn(),)),
    (A, {}, RESPAWNED, life.StopRequested(), X, (life.Settle(),)),
    (X, {}, PLAIN, life.Start(), S, (life.Spawn(),)),
    (F, {}, PLAIN, life.Start(), S, (life.Spawn(),)),
    # An operator's requests.
    (K, {}, PLAIN, life.Start(), S, (life.Spawn(),)),
    (A, {}, RESPAWNED, life.Start(), S, (life.Settle(), life.Spawn())),
    (W, {}, PLAIN, life.Halt(), K, ()),
    (S, {}, PLAIN, life.Halt(), S, ()),
    (U, {}, AWAITED, life.Halt(), O, (life.Unwatch(), ASK)),
    (R, {}, AWAITED, life.Halt(), O, (ASK,)),
    (O, {"unasked": True, "ending": BAD}, RESPAWNED, life.Halt(), O, ()),
    (A, {}, RESPAWNED, life.Halt(), X, (life.Settle(),)),
    (U, {}, AWAITED, life.Renew(), O, (life.Unwatch(), ASK)),
    (R, {}, AWAITED, life.Renew(), O, (ASK,)),
    (O, {}, PLAIN, life.Renew(), O, ()),
    (O, {"again": True}, PLAIN, life.Ended(BAD, remains=False, now=9.0), S, (life.Settle(), life.Spawn())),
    (O, {"again": True, "ending": BAD}, PLAIN, life.Gone(9.0), S, (life.Settle(), life.Spawn())),
    (A, {}, RESPAWNED, life.Renew(), S, (life.Settle(), life.Spawn())),
    (X, {}, PLAIN, life.Renew(), S, (life.Spawn(),)),
    (F, {}, PLAIN, life.Renew(), S, (life.Spawn(),)),
    (K, {}, PLAIN, life.Renew(), S, (life.Spawn(),)),
    # Signs of life.
    (S, {}, GUARDED, life.Started(9.0), U, (life.Guard(),)),
    (S, {}, ABORTED, life.Started(9.0), U, (life.Watch(5.0),)),
    (U, {}, ABORTED, life.Satisfied(), R, (life.Unwatch(), life.Guard())),
    (U, {}, GUARDED, life.Hung("no message"), O, (life.Unguard(), ASK)),
    (R, {}, ABORTED, life.Hung("no message"), O, (life.Unguard(), life.Send("SIGABRT", POLITE, 2.0))),
    (R, {}, ABORTED, life.StopRequested(), O, (life.Unguard(), ASK)),
    (
        O,
        {"hang": "mute", "unasked": True},
        PLAIN,
        life.Ended(GOOD, remains=False, now=9.0),
        F,
        (life.Settle(),),
    ),
    # A managed lifecycle node.
    (U, {"been_ready": True}, MANAGED, life.StopRequested(), O, (life.Quiesce(1.5),)),
    (U, {"been_ready": True}, MANAGED, life.Renew(), O, (life.Quiesce(1.5),)),
    (U, {"been_ready": True}, PATIENT, life.StopRequested(), O, (life.Quiesce(20.0),)),
    (O, {"rung": QUIESCE}, MANAGED, life.RungExpired(QUIESCE), O, (ASK,)),
    (O, {"rung": QUIESCE}, MANAGED, life.Escalated(TERMINATE), O, (TERM,)),
]

EVENTS: list[Event] = [
    life.Start(),
    life.Skip(),
    life.Started(9.0),
    life.Unstartable(LOST, 9.0),
    life.Satisfied(),
    life.ReadyExpired(),
    life.Ended(GOOD, remains=False, now=9.0),
    life.Gone(9.0),
    life.StopAhead(),
    life.StopRequested(),
    life.Halt(),
    life.Renew(),
    life.Hung("no message"),
    life.Escalated(KILL),
    life.RungExpired(POLITE),
    life.DelayOver(),
]


@pytest.mark.parametrize(("phase", "holds", "rules", "event", "following", "effects"), TRANSITIONS)
def test_each_transition(
    phase: Phase,
    holds: dict[str, object],
    rules: Rules,
    event: Event,
    following: Phase,
    effects: tuple[Effect, ...],
) -> None:
    before = replace(State(phase), **holds)  # type: ignore[arg-type]
    after, done = transition(rules, before, event)
    assert (after.phase, done) == (following, effects)


def test_every_transition_of_the_machine_is_in_this_table() -> None:
    assert {(phase, type(event)) for phase, _, _, event, _, _ in TRANSITIONS} == set(_TABLE)


def test_whatever_is_not_in_the_table_changes_nothing() -> None:
    known = {(phase, type(event)) for phase, _, _, event, _, _ in TRANSITIONS}
    for phase, event in itertools.product(Phase, EVENTS):
        if (phase, type(event)) not in known:
            assert transition(PLAIN, State(phase), event) == (State(phase), ())


def test_every_kind_of_event_is_tried() -> None:
    assert {type(event) for event in EVENTS} == set(life.Event.__args__)


def test_a_start_counts_and_a_process_without_condition_is_ready_by_running() -> None:
    after, _ = transition(PLAIN, State(Phase.STARTING), life.Started(4.0))
    assert (after.starts, after.been_ready, after.started_at) == (1, True, 4.0)
    after, _ = transition(AWAITED, State(Phase.STARTING), life.Started(4.0))
    assert not after.been_ready


def test_the_ladder_takes_what_the_description_says() -> None:
    rules = Rules(stop=Stop("SIGTERM", timeout=7.0, kill_timeout=3.0))
    state, effects = transition(rules, State(Phase.RUNNING), life.StopRequested())
    assert effects == (life.Send("SIGTERM", POLITE, 7.0),)
    _, effects = transition(rules, state, life.RungExpired(POLITE))
    assert effects == (life.Send("SIGTERM", TERMINATE, 3.0),)


ENDINGS = st.sampled_from([GOOD, BAD, Ending(signal=11)])
ANY_EVENT = st.one_of(
    st.sampled_from(EVENTS),
    st.builds(life.Ended, ENDINGS, st.booleans(), st.just(9.0)),
    st.builds(life.Escalated, st.sampled_from([POLITE, TERMINATE, KILL])),
    st.builds(life.RungExpired, st.sampled_from([POLITE, TERMINATE, KILL])),
)
ANY_RULES = st.builds(
    Rules,
    restart=st.one_of(
        st.none(),
        st.builds(
            Restart,
            st.sampled_from(["no", "on-failure", "always"]),
            delay=st.sampled_from([0.0, 1.5]),
            budget=st.one_of(st.none(), st.integers(0, 3)),
        ),
    ),
    awaits_ready=st.booleans(),
)


@given(ANY_RULES, st.lists(ANY_EVENT, max_size=60))
def test_any_order_of_events_keeps_the_promises(rules: Rules, events: list[Event]) -> None:
    """One program at a time, no start after a stop, a ladder that only climbs, and a program until it has ended."""
    state, running, asked = State(), False, False
    for event in events:
        if not _can_happen(event, running=running, state=state):
            continue
        before = state
        state, effects = transition(rules, before, event)
        wanted = isinstance(event, life.Start | life.Renew)
        asked = (asked or isinstance(event, life.StopRequested | life.StopAhead | life.Halt)) and not wanted
        spawned = life.Spawn() in effects
        assert not (spawned and running and not _is_over(event, state))
        assert not (spawned and asked)
        if before.phase is Phase.STOPPING and state.phase is Phase.STOPPING:
            assert state.rung >= before.rung
        running = (running or isinstance(event, life.Started)) and not _is_over(event, state)
        assert running <= (state.phase in LIVE)
        assert state.phase is not Phase.STARTING or not running
        assert not (state.phase in FINAL and running)


def _can_happen(event: Event, *, running: bool, state: State) -> bool:
    """Only what the world can tell: a program starts when it was spawned, and ends when it runs."""
    match event:
        case life.Started() | life.Unstartable():
            return state.phase is Phase.STARTING and not running
        case life.Ended():
            return running and state.ending is None
        case life.Gone():
            return running and state.ending is not None
    return True


def _is_over(event: Event, state: State) -> bool:
    ended_clean = isinstance(event, life.Ended) and not event.remains
    return ended_clean or isinstance(event, life.Gone) or state.phase in FINAL
