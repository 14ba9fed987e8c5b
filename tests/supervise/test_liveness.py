"""Processes that give no sign of life, and those that only seem to."""

from __future__ import annotations

import os
import signal
import sys
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.plan.conditions import Alive
from orchestra.supervise.loop import Loop
from orchestra.supervise.signs.deadline import Deadline
from orchestra.supervise.signs.message_rate import MessageRate
from orchestra.supervise.signs.threads import threads
from orchestra.values import Restart, Stop
from tests.supervise.plans import PROCESSES, finished, launched, plan, process, wait_for
from tests.supervise.test_loop import Clock
from tests.supervise.test_notification import notifier
from tests.supervise.test_readiness import ready, text

if TYPE_CHECKING:
    from pathlib import Path

    from tests.supervise.plans import Launched

AGAIN = Restart("on-failure")
# More often than twice in this time a process says that it lives, on the busiest machine.
PERIOD = 2.0


def hung(run: Launched, name: str, count: int = 1) -> str:
    """Wait for the n-th time that a process hangs, and return why."""
    reason: str = run.await_event("process_hung", name, count).data["reason"]
    return reason


def test_a_process_whose_watchdog_falls_silent_is_dumped_and_restarted(tmp_path: Path) -> None:
    """Its first run falls silent, the next one does not."""
    script = (
        f"if test -e {tmp_path}/before; then last=every=0.1,0; else last=every=0.1,3; fi; "
        f'touch {tmp_path}/before; exec "$@" tell=READY=1 $last linger'
    )
    words = (sys.executable, "-S", "-E", str(PROCESSES / "notifier.py"))
    node = process(
        "node",
        command=("sh", "-c", script, "sh", *words),
        restart=AGAIN,
        ready=ready(notify=True),
        alive=Alive(notify=PERIOD),
    )
    with launched(tmp_path, plan(node)) as run:
        assert hung(run, "node") == f"no WATCHDOG=1 for {PERIOD:g} s"
        run.await_event("process_ready", "node", 2)
        run.send(signal.SIGINT)
        assert run.wait() == 130
    assert len(run.of_kind("process_hung")) == 1
    dump = run.of_kind("process_hung")[0].data["threads"]
    assert {thread["pid"] for thread in dump} == {run.of_kind("process_running", "node")[0].pid}
    assert all(thread["state"] for thread in dump)
    (ended, _) = run.of_kind("process_ended", "node")
    assert ended.data["hang"] == f"no WATCHDOG=1 for {PERIOD:g} s"
    assert run.kinds("node").index("process_hung") < run.kinds("node").index("process_stopping")
    assert "node hangs (no WATCHDOG=1 for 2 s) and is ended" in text(run)
    assert "where node is: " in text(run)
    assert ", thread " in text(run)


def test_it_is_expected_only_once_it_is_ready(tmp_path: Path) -> None:
    """It is silent for longer than it may be, then ready, and silent still."""
    go = tmp_path / "go"
    node = notifier("node", "linger", ready=ready(file=str(go)), alive=Alive(notify=0.3))
    with launched(tmp_path, plan(node, process("waits", command=("sleep", "0.9")))) as run:
        run.await_event("process_exited", "waits")
        assert not run.of_kind("process_hung")
        go.touch()
        run.wait()
    first, then = run.of_kind("process_ready", "node")[0], run.of_kind("process_hung", "node")[0]
    assert then.monotonic - first.monotonic >= 0.29
    assert run.kinds("node")[-1] == "process_failed"


def test_without_readiness_it_is_expected_from_its_first_time_on(tmp_path: Path) -> None:
    go = tmp_path / "go"
    node = notifier("node", f"await={go}", "tell=WATCHDOG=1", "linger", alive=Alive(notify=0.3))
    with launched(tmp_path, plan(node, process("waits", command=("sleep", "0.9")))) as run:
        run.await_event("process_exited", "waits")
        assert not run.of_kind("process_hung")
        go.touch()
        assert hung(run, "node") == "no WATCHDOG=1 for 0.3 s"
        run.wait()


def test_a_stopped_process_does_not_hang(tmp_path: Path) -> None:
    """Whoever stops it, or debugs it, wants it so; its time begins anew when it goes on."""
    node = notifier(
        "node", "tell=READY=1", "every=0.1,0", ready=ready(notify=True), alive=Alive(notify=PERIOD)
    )
    with launched(tmp_path, plan(node)) as run:
        run.await_event("process_ready", "node")
        pid = run.of_kind("process_running", "node")[0].pid
        assert pid is not None
        os.kill(pid, signal.SIGSTOP)
        told = "node gives no sign of life, but is stopped: it does not count as hung"
        wait_for(lambda: told in run.stderr, "what is told of it")
        os.kill(pid, signal.SIGCONT)
        run.send(signal.SIGINT)
        assert run.wait() == 130
    assert not run.of_kind("process_hung")
    assert run.stderr.count(told) == 1


def test_time_in_which_we_were_stopped_ourselves_does_not_count(tmp_path: Path) -> None:
    node = notifier("node", "tell=READY=1", "every=0.1,0", ready=ready(notify=True), alive=Alive(notify=0.8))
    with launched(tmp_path, plan(node, process("waits", command=("sleep", "3")))) as run:
        run.await_event("process_ready", "node")
        pids = [run.own("orc-supervisor"), run.of_kind("process_running", "node")[0].pid or 0]
        for pid in pids:
            os.kill(pid, signal.SIGSTOP)
        wait_for(lambda: _ended(run, "sleep"), "the end of a program that nobody reaps")
        for pid in pids:
            os.kill(pid, signal.SIGCONT)
        run.await_event("process_exited", "waits")
        run.send(signal.SIGINT)
        assert run.wait() == 130
    assert not run.of_kind("process_hung")


def _ended(run: Launched, name: str) -> bool:
    """Tell whether a program below the supervisor is a zombie, or gone."""
    return not [pid for pid in run.everything() if _comm(pid) == name]


def _comm(pid: int) -> str:
    try:
        with open(f"/proc/{pid}/comm") as file:  # noqa: PTH123 - as short as it gets
            return file.read().strip()
    except OSError:
        return ""


@pytest.mark.parametrize(
    ("words", "alive", "reason"),
    [
        (("tell=WATCHDOG=trigger",), Alive(notify=60.0), "it said WATCHDOG=trigger"),
        (("tell=WATCHDOG_USEC=300000",), Alive(notify=60.0), "no WATCHDOG=1 for 0.3 s"),
        (("tell=WATCHDOG_USEC=0|WATCHDOG_USEC=soon",), Alive(notify=0.3), "no WATCHDOG=1 for 0.3 s"),
        (
            ("tell=STOPPING=1|WATCHDOG=1",),
            Alive(notify=60.0),
            "it has not ended within 0.5 s after STOPPING=1",
        ),
    ],
)
def test_what_a_process_says_of_its_own_watchdog(
    tmp_path: Path, words: tuple[str, ...], alive: Alive, reason: str
) -> None:
    """What it says of that before it is ready is not heard."""
    stop = Stop(timeout=0.3, kill_timeout=0.2)
    node = notifier(
        "node",
        "say=up",
        f"await={tmp_path / 'go'}",
        *words,
        "linger",
        ready=ready(log="up"),
        alive=alive,
        stop=stop,
    )
    with launched(tmp_path, plan(node)) as run:
        run.await_event("process_ready", "node")
        (tmp_path / "go").touch()
        assert hung(run, "node") == reason
        run.wait()
    assert run.of_kind("process_failed", "node")


def test_a_period_that_is_said_before_counts_in_this_run_only(tmp_path: Path) -> None:
    """The first run wants to be watched closely and says so early, the second one does not."""
    script = (
        'test -e again || close=tell=WATCHDOG_USEC=300000; touch again; exec "$@" $close tell=READY=1 linger'
    )
    words = (sys.executable, "-S", "-E", str(PROCESSES / "notifier.py"))
    node = process(
        "node",
        command=("sh", "-c", script, "sh", *words),
        cwd=str(tmp_path),
        restart=Restart("on-failure", budget=1),
        ready=ready(notify=True),
        alive=Alive(notify=0.4),
    )
    run = finished(tmp_path, plan(node))
    reasons = [event.data["reason"] for event in run.of_kind("process_hung", "node")]
    assert reasons == ["no WATCHDOG=1 for 0.3 s", "no WATCHDOG=1 for 0.4 s"]


def test_a_process_that_says_that_it_stops_and_ends_has_not_hung(tmp_path: Path) -> None:
    words = ("tell=READY=1", "tell=STOPPING=1", "exit=0")
    node = notifier("node", *words, ready=ready(notify=True), alive=Alive(notify=0.2))
    run = finished(tmp_path, plan(node))
    assert run.popen.returncode == 0
    assert run.kinds("node")[-1] == "process_exited"


def test_failures_in_a_row_are_a_hang(tmp_path: Path) -> None:
    """The third of its attempts succeeds, so the first two do not count."""
    script = (
        f'echo x >> {tmp_path}/count; test "$(wc -l < {tmp_path}/count)" = 3 || {{ echo no answer; exit 1; }}'
    )
    alive = Alive(command=("sh", "-c", script), interval=0.05, timeout=20.0, failures=3)
    run = finished(tmp_path, plan(process("node", "say=up", "linger", ready=ready(log="up"), alive=alive)))
    (event,) = run.of_kind("process_hung", "node")
    assert event.data["reason"] == "its command failed 3 times in a row: exit code 1: no answer"
    assert (tmp_path / "count").read_text() == "x\n" * 6


def test_without_readiness_failures_count_from_the_first_success_on(tmp_path: Path) -> None:
    script = f'echo x >> {tmp_path}/count; test "$(wc -l < {tmp_path}/count)" = 4'
    alive = Alive(command=("sh", "-c", script), interval=0.05, timeout=20.0, failures=2)
    run = finished(tmp_path, plan(process("node", "linger", alive=alive)))
    assert len(run.of_kind("process_hung", "node")) == 1
    assert (tmp_path / "count").read_text() == "x\n" * 6


def test_a_command_that_takes_too_long_has_failed(tmp_path: Path) -> None:
    alive = Alive(command=("sleep", "60"), interval=0.05, timeout=0.2, failures=1)
    run = finished(tmp_path, plan(process("node", "say=up", "linger", ready=ready(log="up"), alive=alive)))
    (event,) = run.of_kind("process_hung", "node")
    assert event.data["reason"] == "its command failed: it took longer than 0.2 s"


def test_a_required_process_that_hung_has_failed_whatever_its_exit_code(tmp_path: Path) -> None:
    node = process(
        "node", "polite=0", "say=up", "linger", required=True, ready=ready(log="up"), alive=Alive(notify=0.2)
    )
    run = finished(tmp_path, plan(node))
    assert run.popen.returncode == 1
    assert "required process node failed (it hung, no WATCHDOG=1 for 0.2 s: exit code 0)" in text(run)


def test_a_process_that_hangs_may_get_sigabrt_first(tmp_path: Path) -> None:
    """A Python program then writes where it is, as PYTHONFAULTHANDLER says."""
    script = "import os, time\nos.write(1, b'up\\n')\ndef stuck():\n    time.sleep(600)\nstuck()"
    node = process(
        "node",
        command=(sys.executable, "-c", script),
        ready=ready(log="up"),
        alive=Alive(notify=0.2, abort=True),
    )
    run = finished(tmp_path, plan(node))
    assert run.of_kind("signal_sent", "node")[0].data["signal"] == "SIGABRT"
    assert "line 4 in stuck" in run.log("node")
    assert str(run.of_kind("process_ended", "node")[0].data["signal"]) == str(int(signal.SIGABRT))


def test_every_thread_is_told_of(tmp_path: Path) -> None:
    script = (
        "import os, threading\n"
        "for _ in range(3): threading.Thread(target=threading.Event().wait).start()\n"
        "os.write(1, b'up\\n')\n"
    )
    node = process(
        "node", command=(sys.executable, "-S", "-c", script), ready=ready(log="up"), alive=Alive(notify=0.2)
    )
    run = finished(tmp_path, plan(node))
    (event,) = run.of_kind("process_hung", "node")
    assert len({thread["tid"] for thread in event.data["threads"]}) == 4


def test_threads_of_what_has_gone_are_none() -> None:
    assert threads([2**22 + 1]) == []
    (own,) = [thread for thread in threads([os.getpid()]) if thread.tid == os.getpid()]
    assert (own.pid, own.state) == (os.getpid(), "R")
    assert str(own).endswith(f"(pid {os.getpid()}, thread {os.getpid()}): runs") or " in " in str(own)


class _Bench:
    """A loop whose clock is moved by hand."""

    def __init__(self) -> None:
        self.clock = Clock()
        self.loop = Loop(self.clock)
        self.told: list[str] = []

    def pass_time(self, seconds: float) -> None:
        """Let time pass as it does, and do what is due when it is."""
        for _ in range(round(seconds * 10)):
            self.after(0.1)

    def after(self, seconds: float) -> None:
        """Let time pass as if we were stopped meanwhile, and do what is due."""
        self.clock.now += seconds
        timer = self.loop.call_later(0.0, lambda: None)
        self.loop.run_once()
        timer.cancel()


def test_a_deadline_is_put_off_by_every_sign() -> None:
    bench = _Bench()
    deadline = Deadline(bench.loop, lambda: bench.told.append("expired"))
    deadline.begin(10.0)
    for _ in range(5):
        bench.pass_time(6.0)
        deadline.sign()
    bench.pass_time(9.5)
    assert not bench.told
    bench.pass_time(0.6)
    assert bench.told == ["expired"]
    assert not deadline.runs
    bench.loop.close()


def test_a_deadline_that_comes_much_too_late_begins_anew() -> None:
    bench = _Bench()
    deadline = Deadline(bench.loop, lambda: bench.told.append("expired"))
    deadline.begin(10.0)
    bench.after(30.0)
    bench.pass_time(9.5)
    assert not bench.told
    bench.pass_time(0.6)
    assert bench.told == ["expired"]
    deadline.begin(10.0)
    bench.after(30.0)
    bench.after(30.0)
    assert bench.told == ["expired"] * 2
    bench.told.pop()
    deadline.begin(10.0)
    deadline.end()
    bench.after(10.0)
    assert bench.told == ["expired"]
    bench.loop.close()


class _Observers:
    """Takes orders, and says what a test wants it to say."""

    def __init__(self) -> None:
        self.orders: list[dict[str, Any]] = []
        self.open: set[str] = set()

    def order(self, name: str, order: dict[str, Any], _environment: object, heard: Any) -> None:
        self.orders.append(order)
        self.open.add(name)
        self.say = heard

    def forget(self, name: str) -> None:
        self.open.discard(name)


class _Rates(_Bench):
    """The rate of one topic, of which at least 5 messages a second are wanted in windows of 2 s."""

    def __init__(self, least: float | None = 5.0, *, armed: bool = True) -> None:
        super().__init__()
        self.observers = _Observers()
        self.blind: list[str] = []
        self.rate = MessageRate(
            self.loop,
            self.observers,  # type: ignore[arg-type] # two of its methods
            dict,
            "rate /node",
            ("/scan", least, 2.0),
            self._silent,
            self.blind.append,
        )
        self.rate.begin(armed=armed)

    def _silent(self, reason: str) -> bool:
        self.told.append(reason)
        return True

    def reports(self, *rates: float, every: float = 2.0) -> None:
        for rate in rates:
            self.after(every)
            self.observers.say({"say": "rate", "rate": rate})


def test_too_few_messages_are_a_hang_once_there_were_enough() -> None:
    rates = _Rates()
    assert rates.observers.orders == [{"do": "rate", "topic": "/scan", "window": 2.0}]
    rates.reports(0.0, 7.5, 5.0)
    assert not rates.told
    rates.reports(4.9)
    assert rates.told == ["4.9 messages a second on /scan for 2 s, at least 5 a second are wanted"]
    rates.rate.end()
    assert not rates.observers.open


def test_the_observer_is_given_time_to_meet_the_publisher() -> None:
    rates = _Rates()
    rates.reports(0.0, 0.0)
    assert not rates.told
    rates.reports(0.0)
    assert rates.told == ["no message on /scan for 2 s, at least 5 a second are wanted"]


def test_without_readiness_messages_count_from_the_first_on() -> None:
    rates = _Rates(least=None, armed=False)
    rates.reports(*[0.0] * 10)
    assert not rates.told
    rates.reports(0.5, 0.0)
    assert rates.told == ["no message on /scan for 2 s"]


def test_reports_that_have_waited_for_us_do_not_count() -> None:
    """We, or the observer, were stopped for long: what it said before comes at once."""
    rates = _Rates()
    rates.reports(9.0)
    rates.reports(0.0, every=60.0)
    rates.reports(0.0, 0.0, 0.0, every=0.0)
    assert not rates.told
    rates.reports(0.0)
    assert len(rates.told) == 1


def test_an_observer_that_says_nothing_is_asked_anew_and_no_hang() -> None:
    rates = _Rates()
    rates.reports(9.0)
    rates.pass_time(15.0)
    assert len(rates.observers.orders) == 2
    assert not rates.told


def test_what_cannot_be_seen_is_told_and_no_hang() -> None:
    rates = _Rates()
    rates.observers.say({"say": "impossible", "reason": "/scan carries a/b/C, which cannot be loaded"})
    rates.pass_time(30.0)
    assert rates.blind == ["/scan carries a/b/C, which cannot be loaded"]
    assert not rates.told
    assert len(rates.observers.orders) == 1
