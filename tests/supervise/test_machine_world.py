"""The state machine against a world that answers it: programs, timers, operators and signals in any order."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from hypothesis import given, settings
from hypothesis import strategies as st

from orchestra.supervise.process import life
from orchestra.supervise.process.ending import Ending
from orchestra.supervise.process.life import FINAL, KILL, LIVE, QUIESCE, Phase, Rules, State
from orchestra.supervise.process.machine import transition
from orchestra.values import Restart, Stop

if TYPE_CHECKING:
    from collections.abc import Callable

RULES = st.builds(
    Rules,
    restart=st.none()
    | st.builds(
        Restart,
        st.sampled_from(["no", "on-failure", "always"]),
        delay=st.sampled_from([0.0, 2.0]),
        budget=st.none() | st.integers(0, 2),
        growth=st.sampled_from([1.0, 2.0, 10.0]),
    ),
    stop=st.builds(Stop, st.sampled_from(["SIGINT", "SIGTERM"])),
    awaits_ready=st.booleans(),
    ready_timeout=st.none() | st.just(5.0),
    guarded=st.booleans(),
    aborts=st.booleans(),
    managed=st.booleans(),
)
ENDINGS = st.sampled_from([Ending(code=0), Ending(code=3), Ending(signal=2), Ending(signal=11)])


@dataclass
class World:
    """What the effects have done, and what may happen next."""

    rules: Rules
    now: float = 0.0
    state: State = field(default_factory=State)
    spawning: bool = False
    program: bool = False  # the leader runs
    remains: bool = False  # it has ended, something that it started has not
    killed: bool = False
    watching: bool = False
    guarding: bool = False
    rung: int | None = None  # whose timer runs
    pausing: bool = False
    spawned: int = 0

    def happen(self, event: life.Event) -> None:
        self.state, effects = transition(self.rules, self.state, event)
        for effect in effects:
            self._apply(effect)
        self.check()

    def _apply(self, effect: life.Effect) -> None:
        match effect:
            case life.Spawn():
                assert (self.spawning, self.program, self.remains) == (False, False, False)
                self.spawning, self.killed = True, False
                self.spawned += 1
            case life.Watch() | life.Unwatch():
                self.watching = _switched(self.watching, on=isinstance(effect, life.Watch))
            case life.Guard() | life.Unguard():
                self.guarding = _switched(self.guarding, on=isinstance(effect, life.Guard))
            case life.Quiesce():
                assert self.program
                self.rung = QUIESCE
            case life.Send(signal, rung, timeout):
                assert self.program or self.remains
                self.rung = None if timeout is None else rung
                self.killed = self.killed or signal == "SIGKILL"
            case life.Pause(delay):
                assert delay >= 0.0
                self.pausing = True
            case life.Settle():
                self.rung, self.pausing = None, False
            case life.Missed():
                assert self.state.phase is Phase.RUNNING

    def check(self) -> None:
        phase = self.state.phase
        assert self.spawning == (phase is Phase.STARTING)
        assert (self.program or self.remains) == (phase in LIVE and phase is not Phase.STARTING)
        assert self.program or phase not in (Phase.RUNNING, Phase.READY)
        assert not self.watching or (phase is Phase.RUNNING and self.rules.awaits_ready)
        ready = phase is Phase.READY or (phase is Phase.RUNNING and not self.rules.awaits_ready)
        assert self.guarding == (ready and self.rules.guarded)
        assert (self.rung is not None) == (phase is Phase.STOPPING and self.state.rung != KILL)
        assert self.pausing == (phase is Phase.RESTARTING)
        assert (self.state.hang is None) or phase in (Phase.STOPPING, Phase.RESTARTING, *FINAL)
        if self.state.hang is not None and phase in FINAL and not self.state.asked:
            assert phase is Phase.FAILED

    # What the world can do.

    def spawn_works(self) -> None:
        self.spawning, self.program = False, True
        self.happen(life.Started(self.now))

    def spawn_fails(self) -> None:
        self.spawning = False
        self.happen(life.Unstartable(Ending(code=127, reason="gone"), self.now))

    def leader_ends(self, ending: Ending, *, remains: bool) -> None:
        self.program, self.remains = False, remains
        self.happen(life.Ended(ending, remains, self.now))

    def rest_ends(self) -> None:
        self.remains = False
        self.happen(life.Gone(self.now))

    def rung_expires(self) -> None:
        rung, self.rung = self.rung, None
        assert rung is not None
        self.happen(life.RungExpired(rung))

    def pause_ends(self) -> None:
        self.pausing = False
        self.happen(life.DelayOver())

    def possible(self, draw: Callable[[st.SearchStrategy[object]], object]) -> list[Callable[[], None]]:
        """Everything that could happen now."""
        may: list[Callable[[], None]] = [
            lambda event=event: self.happen(event)  # type: ignore[misc] # a default is no argument of the call
            for event in (life.Start(), life.Halt(), life.Renew(), life.Escalated(1), life.Escalated(KILL))
        ]
        if self.state.phase is Phase.WAITING:
            may.append(lambda: self.happen(life.Skip()))
        if self.spawning:
            may += [self.spawn_works, self.spawn_works, self.spawn_fails]
        if self.program:
            ending = draw(ENDINGS)
            assert isinstance(ending, Ending)
            may += [
                lambda: self.leader_ends(ending, remains=False),
                lambda: self.leader_ends(ending, remains=True),
            ]
        if self.remains:
            may.append(self.rest_ends)
        if self.watching:
            may += [lambda: self.happen(life.Satisfied()), lambda: self.happen(life.ReadyExpired())]
        if self.guarding:
            may.append(lambda: self.happen(life.Hung("no message")))
        if self.rung is not None:
            may.append(self.rung_expires)
        if self.pausing:
            may.append(self.pause_ends)
        return may


def _switched(before: bool, *, on: bool) -> bool:
    assert not (before and on), "switched on twice"
    return on


@given(st.data(), RULES)
@settings(max_examples=400)
def test_any_interleaving_keeps_the_promises_and_comes_to_an_end(data: st.DataObject, rules: Rules) -> None:
    world = World(rules)
    for _ in range(data.draw(st.integers(0, 30))):
        may = world.possible(data.draw)
        data.draw(st.sampled_from(may))()
        world.now += data.draw(st.sampled_from([0.0, 0.5, 20.0]))
    _end(world)
    assert world.state.phase in FINAL


def _end(world: World) -> None:
    """The run ends: nobody asks for anything any more, and the program defies everything but SIGKILL."""
    spawned = world.spawned
    world.happen(life.StopAhead() if world.state.phase in LIVE else life.StopRequested())
    world.happen(life.StopRequested())
    for _ in range(20):
        if world.state.phase in FINAL:
            break
        if world.spawning:
            world.spawn_works()
        elif world.rung is not None:
            world.rung_expires()
        elif world.killed and world.program:
            world.leader_ends(Ending(signal=9), remains=True)
        elif world.killed:
            world.rest_ends()
    assert world.spawned == spawned


@given(st.data(), RULES)
def test_a_restart_that_is_wanted_is_no_failure(data: st.DataObject, rules: Rules) -> None:
    world = World(rules)
    world.happen(life.Start())
    world.spawn_works()
    if world.watching and data.draw(st.booleans()):
        world.happen(life.Satisfied())
    for _ in range(data.draw(st.integers(1, 5))):
        world.happen(life.Renew())
        while world.rung is not None and data.draw(st.booleans()):
            world.rung_expires()
        world.leader_ends(data.draw(ENDINGS), remains=False)
        assert world.state.phase is Phase.STARTING
        world.spawn_works()
    assert world.state.short_runs == 0
