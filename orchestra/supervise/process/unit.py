"""One process of the plan in action: carries out what its state machine decides, and tells it what happens."""

from __future__ import annotations

import signal
from functools import partial
from typing import TYPE_CHECKING, Any

from orchestra.logs.names import shown
from orchestra.logs.tail import Tail
from orchestra.supervise.crash.crashes import Crashes
from orchestra.supervise.keeping.kin import send_as_asked, send_to_groups
from orchestra.supervise.output.writing import Output
from orchestra.supervise.process import life
from orchestra.supervise.process.account import Account
from orchestra.supervise.process.ending import Ending, unstartable
from orchestra.supervise.process.life import LIVE, Phase, State
from orchestra.supervise.process.machine import ladder, transition
from orchestra.supervise.process.order import Life
from orchestra.supervise.process.rules import rules_of
from orchestra.supervise.process.spec import Spec, argv
from orchestra.supervise.signs.liveness import Liveness
from orchestra.supervise.signs.notification import Notices
from orchestra.supervise.signs.readiness import Readiness

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.plan.model import Process
    from orchestra.supervise.keeping.kin import Adopted
    from orchestra.supervise.loop import Timer
    from orchestra.supervise.output.attachment import Attachment
    from orchestra.supervise.process.child import Child
    from orchestra.supervise.surroundings import Listener, Surroundings

# Enough for the stacks of an interpreter that has crashed.
_LAST_LINES = 100


class Unit:
    """A process of the plan from its first wait to its last end."""

    def __init__(self, process: Process, surroundings: Surroundings, listener: Listener) -> None:
        self.process = process
        self.id = process.id
        self.name = shown(process.id)
        self.rules = rules_of(process)
        self.state = State()
        self.tail = Tail(_LAST_LINES)
        self._crashes = Crashes(process, self.rules, surroundings)
        self._account = Account(process.id, self.rules, surroundings)
        self._around = surroundings
        self._listener = listener
        self._child: Child | None = None
        self._output = Output(process.id, surroundings, self._heard, partial(listener.wrote, process.id))
        self._notices = Notices(process, surroundings)
        self._readiness = Readiness(
            process,
            surroundings,
            self._notices,
            self.handle,
            lambda problem: listener.failed(f"cannot tell whether {self.name} is ready: {problem}"),
        )
        self._liveness = Liveness(
            process,
            surroundings,
            self._notices,
            self.handle,
            lambda problem: listener.went_wrong(f"cannot tell whether {self.name} is alive: {problem}"),
        )
        self._timers: dict[str, Timer] = {}
        self._sending = False
        self._plainly: dict[type[Any], Callable[[], None]] = {
            life.Spawn: self._spawn,
            life.Unwatch: self._readiness.end,
            life.Guard: self._liveness.begin,
            life.Unguard: self._liveness.end,
            life.Settle: self._settle,
            life.Missed: self._missed,
        }

    @property
    def standing(self) -> Life:
        """What the others may know."""
        return Life(self.rules, self.state)

    @property
    def pid(self) -> int | None:
        """The pid of the program; it may have ended already."""
        return self._child.pid if self._child else None

    @property
    def attachment(self) -> Attachment:
        """Where its output can be followed, and where somebody may type to it."""
        return self._output.attachment

    @property
    def over(self) -> bool:
        """Whether it ran, or failed to, and will not start again by itself."""
        return self.state.phase in (Phase.EXITED, Phase.FAILED)

    @property
    def awaits_message(self) -> bool:
        """Whether it needs the observer, now or at its next start."""
        if self.state.phase in life.FINAL or self.state.phase is Phase.STOPPING:
            return False
        awaits = self.state.phase is not Phase.READY and self._readiness.looks_into_graph
        return awaits or self._liveness.looks_into_graph

    @property
    def awaited(self) -> str:
        """What its readiness waits for, in words."""
        return self._readiness.words

    def handle(self, event: life.Event) -> None:
        """Let something happen to it."""
        before = self.state
        if isinstance(event, life.Hung):
            self._crashes.hung(self._around.kin.members(self.id))
        self.state, effects = transition(self.rules, before, event)
        self._crashes.entered(self.state.phase)
        if self.state.phase is not before.phase:
            if self.over and self.state.ending:
                self._listener.completed(self.id, self.state.ending, intended=self.state.halted)
            self._account.entered(self.state, event, self.pid)
        for effect in effects:
            self._perform(effect)
        if self.state.asked and self.state.phase is Phase.STARTING:
            self._around.starts.withdraw(self.id)
        if self.state.phase is not before.phase:
            self._listener.changed(self.id)

    def signal(self, number: int) -> None:
        """Send a signal that the plan wants to be sent, where it runs."""
        if self._child:
            self._account.signalled(self.pid, number)
            self._crashes.signalled(number)
            send_as_asked(self._child.pid, number)

    def adopted(self, adopted: Adopted) -> None:
        """Take note of a descendant that detached itself. While stopping, it gets the signal that the others had."""
        self._account.adopted(adopted)
        if self.state.phase is Phase.STOPPING:
            if not self._sending and self.state.rung > life.QUIESCE:  # else its signal is still to come
                self._signal_late(adopted)
        elif self.state.phase not in LIVE:
            self._account.left_behind(adopted)
            send_to_groups([adopted.pid], signal.SIGTERM)

    def nothing_left(self) -> None:
        """The last adopted descendant has ended."""
        if self._child and self.state.phase is Phase.STOPPING and self.state.ending and self._child.ended():
            self._bury()
            self.handle(life.Gone(self._around.loop.clock()))

    def _perform(self, effect: life.Effect) -> None:
        match effect:
            case life.Send():
                self._send(effect)
            case life.Pause(delay, jitter):
                import random  # noqa: PLC0415 - what never ends by itself needs no pause

                self._pause(delay * (1.0 + jitter * random.random()))  # noqa: S311 - nobody has to guess it
            case life.Watch(timeout):
                self._watch(timeout)
            case life.Quiesce(timeout):
                self._set_timer("rung", timeout, life.RungExpired(life.QUIESCE))
                self._listener.quiesce(self.id, partial(self.handle, life.RungExpired(life.QUIESCE)))
            case _:
                self._plainly[type(effect)]()

    def _settle(self) -> None:
        self._cancel("rung")
        self._cancel("pause")

    def _pause(self, delay: float) -> None:
        if delay:
            self._crashes.write()
        self._account.say("starts again" + (f" in {delay:.3g} s" if delay else ""))
        self._set_timer("pause", delay, life.DelayOver())

    def _spawn(self) -> None:
        process = self.process
        environment = self._around.environment(process)
        tty, stdin = bool(process.emulate_tty), bool(process.stdin)
        foremost = stdin and self._around.console.interactive
        try:
            own = self._notices.begin()
            environment.update(own)
            self._crashes.begins(own)
            self.tail = Tail(_LAST_LINES)
            before, mark = self._around.confines.prepare(process), self._around.kin.number(self.id)
        except OSError as error:
            self.failed(error)
            return
        spec = Spec(self.id, argv(process), environment, process.cwd, tty, stdin, before, foremost, mark)
        self._around.starts.start(process, spec, self)

    def begun(self, child: Child, spec: Spec) -> None:
        """Its program runs."""
        self._child = child
        self._around.kin.add(child.pid, self.id)
        self._around.confines.started(self.process, child.pid)
        self._output.begin(child, spec.environment, foremost=spec.foremost)
        self._around.loop.on_readable(child.pidfd, self._exited)
        self.handle(life.Started(self._around.loop.clock()))
        self._listener.started(self.id, child.pid)

    def cold(self, reason: str) -> None:
        """It is started by itself, although the plan says otherwise."""
        self._account.cold(reason)

    def failed(self, error: OSError) -> None:
        """Its program could not be started."""
        self._not_started(unstartable(error))

    def _not_started(self, ending: Ending) -> None:
        self._notices.end()
        self._around.confines.release(self.id)
        self._account.not_started(ending)
        self._crashes.ended(self.state, ending, None, self.tail)
        self._listener.ended(self.id, None, ending, intended=False)
        self.handle(life.Unstartable(ending, self._around.loop.clock()))

    def _exited(self) -> None:
        """The program itself has ended; what it started may have not."""
        child = self._child
        ended = child.ended() if child else None
        if child is None or ended is None:
            return
        self._around.loop.forget(child.pidfd)
        self._output.drain()
        self._notices.drain()
        self._listener.look()
        left = self._around.kin.of(self.id)
        remains, ending = bool(left), Ending(*ended, hang=self.state.hang)
        self._account.ended(self.state, ending, child.pid, left)
        if not remains:
            self._bury()
        self._crashes.ended(self.state, ending, child, self.tail)
        self._listener.ended(self.id, child.pid, ending, intended=self.state.again or self.state.halted)
        self.handle(life.Ended(ending, remains, self._around.loop.clock()))

    def _bury(self) -> None:
        """Nothing of this run is left: read the rest of its output, and give everything back."""
        self._output.end()
        self._notices.end()
        if self._child:
            self._around.kin.remove(self._child.pid)
            self._child.reap()
        self._child = None
        self._around.confines.release(self.id)

    def _heard(self, stream: str, data: bytes) -> None:
        self.tail.feed(data)
        self._readiness.read(stream, data)

    def _watch(self, timeout: float | None) -> None:
        self._readiness.begin(timeout)

    def _missed(self) -> None:
        timeout = self.rules.ready_timeout
        self._listener.failed(
            f"{self.name} was not ready within {timeout:g} s: waited for {self.awaited}", self.id
        )

    def _send(self, step: life.Send) -> None:
        self._sending = True
        self._listener.look()
        self._sending = False
        if self.state.phase is not Phase.STOPPING:
            return  # that look has found that nothing is left
        if step.rung > life.POLITE:
            self._account.say(f"has not ended yet: {step.signal}")
        members = [adopted.pid for adopted in self._around.kin.of(self.id)]
        self._account.signalled(self.pid, step.signal)
        send_to_groups([*([self.pid] if self.pid else []), *members], signal.Signals[step.signal])
        self._cancel("rung")
        if step.timeout is not None:
            self._set_timer("rung", step.timeout, life.RungExpired(step.rung))

    def _signal_late(self, adopted: Adopted) -> None:
        """Signal what came out of the process only now; its own group has had the signal already."""
        step = ladder(self.rules.stop, self.state.rung)
        if step.rung == life.KILL or self._around.kin.group(adopted.pid) != self.pid:
            send_to_groups([adopted.pid], signal.Signals[step.signal])

    def _set_timer(self, name: str, delay: float, event: life.Event) -> None:
        self._cancel(name)
        self._timers[name] = self._around.loop.call_later(delay, lambda: self.handle(event))

    def _cancel(self, name: str) -> None:
        timer = self._timers.pop(name, None)
        if timer:
            timer.cancel()
