"""The process that the user started: it forwards signals, waits, and clears up when the supervisor dies.

It owns the terminal: it alone is in the foreground process group, so that Ctrl-C is heard once. It is a subreaper, so
that whatever the supervisor started becomes its child when the supervisor dies (prctl(2)). It does nothing that can
fail or block: no plan, no logs, no import of user code.

Signals are blocked and fetched with sigtimedwait(2): no handler runs, nothing is lost between two waits, and it makes
no difference that SIGINT was ignored when we were started, as a shell does for a job in the background. An ignored
SIGHUP stays ignored (`signals` says why). Since SIGTTOU is blocked too, what we write to the terminal does not stop us
in the background, whatever `stty tostop` says (tty_ioctl(4)).
"""

from __future__ import annotations

import os
import signal
import time

from orchestra.supervise.keeping import kernel, proc, terminal_modes
from orchestra.supervise.keeping.patience import LOOK_AGAIN, USUAL, Effort, standstill
from orchestra.supervise.keeping.signals import received_signals, stop_signals
from orchestra.supervise.keeping.standard_streams import flush, say
from orchestra.supervise.keeping.sweeping import reap, sweep

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.keeping.guard import Guard
    from orchestra.supervise.keeping.patience import Patience
    from orchestra.supervise.keeping.stacks import Stacks
    from orchestra.supervise.keeping.terminal_modes import Modes

# From this Ctrl-C on everything is killed at once, and no more time than usual is given for it.
_IMPATIENT = 3

# What the kernel has not ended this long after SIGKILL, it will not end soon: it is in an uninterruptible wait, or
# somebody traces it. In seconds.
_GIVE_UP_AFTER = 1.0

# Of signals that mean something only to the supervisor.
_FORWARDED = frozenset({signal.SIGWINCH, signal.SIGCONT})

FAILED, UNSTOPPABLE = 1, 4
_BUG = 3


def keep(supervise: Callable[[], int], patience: Patience, stacks: Stacks, bury: Callable[[], object]) -> int:
    """Run `supervise` in a child and return its status; 1 where it died of a signal, 4 where something is left.

    One that dies when it has told what the run has come to changes that no more.
    `bury` is called by whoever is left where we are killed as well.
    """
    kernel.set_name("orc-keeper")
    kernel.become_subreaper()
    for number in received_signals():
        signal.signal(number, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_SETMASK, received_signals())
    modes = terminal_modes.kept()
    began = time.time()
    try:
        supervisor = _fork(supervise)
    except OSError as error:
        return no_room(error)
    from orchestra.supervise.keeping.guard import Guard  # noqa: PLC0415 - the supervisor is at work meanwhile

    guard = Guard(supervisor, bury)
    watch = _Watch(supervisor, guard, patience, stacks, modes)
    status = watch.until_it_ends()
    if status is None or not os.WIFEXITED(status):
        terminal_modes.give_back(modes)
    if status is not None and os.WIFEXITED(status) and os.WEXITSTATUS(status) == UNSTOPPABLE:
        guard.dismiss()
        return UNSTOPPABLE  # the supervisor has tried everything, and has named what is left
    # Whoever kills the supervisor may kill us before this is done.
    left = sweep(_pause, guard.pids)
    guard.dismiss()
    left = left or sweep(_pause)
    if status is None or not os.WIFEXITED(status) or os.WEXITSTATUS(status) == _BUG:
        _clear_caps()
        _clear_shared_memory(began)
    if status is not None and os.WIFEXITED(status):
        return UNSTOPPABLE if left else os.WEXITSTATUS(status)
    say(f"the supervisor {_fate(status)}; {_outcome(left)}")
    if left:
        return UNSTOPPABLE
    return FAILED if patience.settled is None else patience.settled


def no_room(error: OSError) -> int:
    """Tell that a run cannot begin for want of a process or of memory, and return its status."""
    say(f"the run cannot begin, for no process can be started: {error.strerror}")
    return FAILED


def _fate(status: int | None) -> str:
    if status is None:
        return "cannot be ended"
    return f"was ended by {signal.Signals(os.WTERMSIG(status)).name}"


def _clear_shared_memory(began: float) -> None:
    """Remove what nodes could not remove themselves."""
    from orchestra.supervise.keeping import shared_memory  # noqa: PLC0415 - as below

    shared_memory.remove_leftovers(began)


def _clear_caps() -> None:
    """Remove what a supervisor that could not do it itself has left of its memory caps."""
    from orchestra.supervise.limits import caps  # noqa: PLC0415 - not every run has some, and few supervisors die

    stuck = caps.clear(os.getpid())
    if stuck:
        say(f"control groups could not be removed: {', '.join(stuck)}")


def _outcome(left: list[int]) -> str:
    if not left:
        return "everything that it had started has been ended"
    return "could not be ended: " + ", ".join(f"{proc.command(pid)} (pid {pid})" for pid in left)


def _fork(supervise: Callable[[], int]) -> int:
    """Start the supervisor: a session of its own, ended by SIGTERM when the keeper dies, whatever way that is."""
    flush()
    keeper = os.getpid()
    pid = os.fork()
    if pid:
        return pid
    status = 3
    try:
        kernel.die_with_parent(signal.SIGTERM, keeper)
        kernel.set_name("orc-supervisor")
        kernel.become_subreaper()
        os.setsid()
        status = supervise()
        flush()
    finally:
        os._exit(status)


class _Watch:
    """The time while the supervisor lives."""

    def __init__(
        self, supervisor: int, guard: Guard, patience: Patience, stacks: Stacks, modes: Modes | None
    ) -> None:
        self._supervisor = supervisor
        self._guard = guard
        self._patience = patience
        self._stacks = stacks
        self._modes = modes
        self._asked_at: float | None = None
        self._effort: Effort | None = None
        self._deadline: float | None = None
        self._interrupts = 0
        self._killed = False

    def until_it_ends(self) -> int | None:
        """Forward signals until the supervisor has ended; return its wait status, None where nothing can end it."""
        while True:
            received = self._next()
            self._guard.renew()
            status = reap(self._supervisor)
            if status is not None:
                return status
            if received is None and self._killed:
                return None
            if received is None:
                self._lose_patience()
            else:
                self._hear(received)

    def _next(self) -> int | None:
        """Return the next signal, None where the deadline has passed. Time in which we stood still does not count."""
        while self._deadline is not None:
            now = time.monotonic()
            seconds = min(max(0.0, self._deadline - now), LOOK_AGAIN)
            received = _fetch(seconds)
            self._deadline += standstill(now, seconds)
            if received is not None:
                return received
            if self._effort:
                self._effort.look()
            if time.monotonic() >= self._deadline:
                return None
        return _fetch(None)

    def _hear(self, number: int) -> None:
        if number in stop_signals():
            self._stop(number)
        elif number == signal.SIGQUIT:
            self._stacks.show("keeper")
            self._stacks.title("supervisor", self._supervisor)
            self._tell(signal.SIGQUIT)
        elif number == signal.SIGTSTP:
            self._suspend()
        elif number in _FORWARDED:
            self._tell(number)

    def _stop(self, number: int) -> None:
        """Forward a stop signal, and wake the supervisor: one that somebody has stopped could not act on it."""
        self._tell(number)
        self._tell(signal.SIGCONT)
        self._interrupts += number == signal.SIGINT
        now = time.monotonic()
        if self._deadline is None or (self._interrupts == _IMPATIENT and not self._killed):
            self._deadline = now + USUAL
        if self._asked_at is None:
            self._asked_at = now
            self._effort = Effort(self._supervisor)

    def _lose_patience(self) -> None:
        """Wait on where the supervisor has asked for it or had no processor, and kill it where it is stuck."""
        more = self._patience.remaining()
        if more <= 0 and self._effort and self._effort.starved:
            more = LOOK_AGAIN
        if more > 0 and self._interrupts < _IMPATIENT:
            self._deadline = time.monotonic() + more
            return
        facts = proc.stat(self._supervisor)
        state = f" (state {facts.state})" if facts else ""
        waited = time.monotonic() - (self._asked_at or 0.0)
        say(f"the supervisor does not answer{state}; it is killed after {waited:.0f} s")
        self._tell(signal.SIGQUIT)
        where = self._stacks.read(0.5)
        if where:
            say(f"it was here:\n{where}")
        self._tell(signal.SIGKILL)
        self._killed = True
        self._deadline = time.monotonic() + _GIVE_UP_AFTER

    def _suspend(self) -> None:
        """Stop, so that the shell goes on; the run does too. We go on when the shell says so (SIGCONT)."""
        if not _can_be_resumed():
            return
        say("suspended, but the run goes on; `fg` brings it back")
        self._tell(signal.SIGTSTP)
        terminal_modes.give_back(self._modes)
        os.kill(os.getpid(), signal.SIGTSTP)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGTSTP})
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTSTP})

    def _tell(self, number: int) -> None:
        """Signal the supervisor, which stays our child until it is reaped."""
        os.kill(self._supervisor, number)


def _can_be_resumed() -> bool:
    """Tell whether a shell started our process group, and can continue it: the kernel does not stop it otherwise.

    That is an orphaned process group (setpgid(2), credentials(7)).
    """
    ours = facts = proc.stat(os.getpid())
    while ours and facts and facts.group == ours.group:
        facts = proc.stat(facts.parent)
    return bool(ours and facts and facts.session == ours.session)


def _fetch(timeout: float | None) -> int | None:
    """Return the next signal, None where the time is over."""
    if timeout is None:
        return signal.sigwaitinfo(received_signals()).si_signo
    received = signal.sigtimedwait(received_signals(), timeout)
    return received.si_signo if received else None


def _pause(seconds: float) -> bool:
    """Wait for a signal and collect our children; a stop signal is a wish to hurry."""
    received = _fetch(seconds)
    reap()
    return received in stop_signals()
