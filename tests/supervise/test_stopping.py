"""The stop ladder, with real processes."""

from __future__ import annotations

import ctypes
import itertools
import os
import signal
import sys
import time
from typing import TYPE_CHECKING

import pytest

from orchestra.values import Restart, Stop
from tests.supervise.plans import after, launched, plan, process, wait_for

if TYPE_CHECKING:
    from pathlib import Path

    from tests.supervise.plans import Launched

STUBBORN = ("ignore=INT,TERM", "say=up", "linger")


def signals(run: Launched, name: str) -> list[str]:
    return [event.data["signal"] for event in run.of_kind("signal_sent", name)]


def test_well_behaved_processes_end_within_three_seconds(tmp_path: Path) -> None:
    many = [process(f"n{number}", "polite", "say=up", "linger") for number in range(8)]
    with launched(tmp_path, plan(*many)) as run:
        for one in many:
            run.await_line(one.id, "up")
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert run.ending < 3.0
        assert not run.everything()
        assert all(signals(run, one.id) == ["SIGINT"] for one in many)
        assert all(run.log(one.id) == "up\nbye\n" for one in many)


@pytest.mark.conforms("4.9 4", "4.9 5", "D33")
@pytest.mark.parametrize(
    ("words", "sent"),
    [
        (("ignore=INT", "say=up", "linger"), ["SIGINT", "SIGTERM"]),
        (STUBBORN, ["SIGINT", "SIGTERM", "SIGKILL"]),
    ],
)
def test_the_ladder_goes_as_far_as_it_must(tmp_path: Path, words: tuple[str, ...], sent: list[str]) -> None:
    with launched(tmp_path, plan(process("a", *words, stop=Stop(timeout=0.3, kill_timeout=0.3)))) as run:
        run.await_line("a", "up")
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert signals(run, "a") == sent
        assert "a has not ended yet: SIGTERM" in run.stderr


def test_the_ladder_begins_with_the_signal_that_the_description_wants(tmp_path: Path) -> None:
    words = ("ignore=INT", "say=up", "linger")
    with launched(tmp_path, plan(process("a", *words, stop=Stop("SIGUSR1")))) as run:
        run.await_line("a", "up")
        run.send(signal.SIGTERM)
        assert run.wait() == 143
        assert run.of_kind("process_ended", "a")[0].data["signal"] == signal.SIGUSR1


@pytest.mark.conforms("D54", "4.9 timeouts")
def test_who_is_given_more_time_than_usual_gets_it(tmp_path: Path) -> None:
    patient = Stop(timeout=5.5, kill_timeout=0.3)
    with launched(tmp_path, plan(process("a", *STUBBORN, stop=patient))) as run:
        run.await_line("a", "up")
        begin = time.monotonic()
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert time.monotonic() - begin > 5.5
        run.assert_gone(1.0)
        assert signals(run, "a") == ["SIGINT", "SIGTERM", "SIGKILL"]


@pytest.mark.conforms("4.9 2", "D32")
def test_impatience_helps(tmp_path: Path) -> None:
    """The second Ctrl-C is a SIGTERM to everything, the third a SIGKILL."""
    with launched(
        tmp_path, plan(process("a", *STUBBORN), process("b", "ignore=INT", "say=up", "linger"))
    ) as run:
        run.await_line("a", "up")
        run.await_line("b", "up")
        for count in (1, 2, 3):
            run.send(signal.SIGINT)
            run.await_event("signal_sent", "a", count=count)
        assert run.wait() == 130
        assert run.ending < 4.5
        assert signals(run, "a") == ["SIGINT", "SIGTERM", "SIGKILL"]
        assert signals(run, "b")[:2] == ["SIGINT", "SIGTERM"]
        assert "SIGINT again: SIGTERM to everything" in run.stderr
        assert "SIGINT again: SIGKILL to everything" in run.stderr


def test_dependents_end_first(tmp_path: Path) -> None:
    base = process("base", "polite", "say=up", "linger")
    middle = process("middle", "polite", "say=up", "linger", depends_on=after("base", "started"))
    top = process("top", "polite", "say=up", "linger", depends_on=after("middle", "started"))
    with launched(tmp_path, plan(base, middle, top)) as run:
        for name in ("base", "middle", "top"):
            run.await_line(name, "up")
        run.send(signal.SIGINT)
        assert run.wait() == 130
        steps = [(e.kind, e.process) for e in run.events if e.kind in ("signal_sent", "process_ended")]
        assert steps == [
            (kind, name) for name in ("top", "middle", "base") for kind in ("signal_sent", "process_ended")
        ]


def test_a_stubborn_dependent_does_not_use_up_the_time_of_the_others(tmp_path: Path) -> None:
    base = process("base", "polite", "say=up", "linger")
    top = process("top", *STUBBORN, depends_on=after("base", "started"))
    with launched(tmp_path, plan(base, top)) as run:
        run.await_line("base", "up")
        run.await_line("top", "up")
        run.send(signal.SIGINT)
        run.await_event("process_exited", "base")
        assert not run.of_kind("process_ended", "top")
        assert run.wait() == 130


def test_what_ends_ahead_of_its_turn_is_neither_failed_nor_started_again(tmp_path: Path) -> None:
    """The base crashes because its dependent has gone, before it is asked itself."""
    command = ("/bin/sh", "-c", "trap '' INT; echo up; read line < pipe; exit 1")
    (tmp_path / "work").mkdir()
    base = process("base", command=command, cwd=str(tmp_path / "work"), restart=Restart("always"))
    top = process("top", *STUBBORN, depends_on=after("base", "started"))
    os.mkfifo(tmp_path / "work" / "pipe")
    with launched(tmp_path, plan(base, top)) as run:
        run.await_line("base", "up")
        run.await_line("top", "up")
        run.send(signal.SIGINT)
        run.await_event("signal_sent", "top")
        (tmp_path / "work" / "pipe").write_text("go\n")
        run.await_event("process_ended", "base")
        assert run.wait() == 130
        assert run.kinds("base")[-1] == "process_exited"
        assert run.kinds("base").count("process_starting") == 1


@pytest.mark.conforms("4.8 delay", "4.9 7")
def test_a_stop_interrupts_the_pause_before_a_restart(tmp_path: Path) -> None:
    with launched(tmp_path, plan(process("a", "exit=1", restart=Restart("always", delay=1000.0)))) as run:
        run.await_event("process_restarting", "a")
        run.send(signal.SIGTERM)
        assert run.wait() == 143


def test_sigstopped_members_end_too(tmp_path: Path) -> None:
    with launched(tmp_path, plan(process("a", "polite", "say=up", "linger"))) as run:
        run.await_line("a", "up")
        pid = run.of_kind("process_running", "a")[0].pid
        assert pid
        os.kill(pid, signal.SIGSTOP)
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert signals(run, "a") == ["SIGINT"]


@pytest.mark.long
def test_the_longest_possible_tree_of_orders(tmp_path: Path) -> None:
    """Twenty levels, each stubborn: the last one is asked before the deadline, and nothing is left."""
    names = [f"n{number}" for number in range(20)]
    chain = [process(names[0], *STUBBORN)]
    chain += [
        process(name, *STUBBORN, depends_on=after(before, "started"))
        for before, name in itertools.pairwise(names)
    ]
    with launched(tmp_path, plan(*chain)) as run:
        for name in names:
            run.await_line(name, "up")
        run.send(signal.SIGINT)
        wait_for(lambda: signals(run, "n0"), "the last of the order to be asked", 5.0)
        assert run.wait() == 130
        assert not run.everything()


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can start what it may not end")
def test_what_cannot_be_stopped_is_named(tmp_path: Path) -> None:
    """The run loses the right to signal others, and its process becomes another user's: as good as unkillable."""
    stranger = f"import os, signal; os.setuid({_NOBODY}); print('up', flush=True); signal.pause()"
    with launched(
        tmp_path,
        plan(process("a", command=(sys.executable, "-S", "-E", "-c", stranger))),
        preexec_fn=_lose_right_to_kill,
    ) as run:
        run.await_line("a", "up")
        pid = run.of_kind("process_running", "a")[0].pid
        run.send(signal.SIGINT)
        assert run.wait() == 4
        assert run.events[-1].data == {"status": 4, "reason": f"could not be stopped: a (pid {pid})"}


def _lose_right_to_kill() -> None:
    """Drop CAP_KILL from the bounding set, so that no program started from here has it (capabilities(7))."""
    assert ctypes.CDLL(None).prctl(_CAPBSET_DROP, _CAP_KILL, 0, 0, 0) == 0


_NOBODY = 65534
_CAPBSET_DROP, _CAP_KILL = 24, 5


@pytest.mark.parametrize(
    "seconds",
    [
        5.8,  # longer than the usual deadline
        pytest.param(11.5, marks=pytest.mark.long),  # longer than the keeper's usual patience
    ],
)
def test_a_description_may_ask_for_more_time(tmp_path: Path, seconds: float) -> None:
    slow = process("slow", f"leisurely={seconds}", "say=up", "linger", stop=Stop(timeout=30.0))
    base = process("base", "polite", "say=up", "linger")
    user = process(
        "user", "polite", "say=up", "linger", depends_on=after("slow", "started") + after("base", "started")
    )
    with launched(tmp_path, plan(slow, base, user)) as run:
        for name in ("slow", "base", "user"):
            run.await_line(name, "up")
        run.send(signal.SIGTERM)
        assert run.wait() == 143
        assert run.log("slow") == "up\nbye\n"
        assert signals(run, "slow") == ["SIGINT"]
        assert not run.everything()


def test_without_a_keeper_nobody_gets_more_time(tmp_path: Path) -> None:
    stubborn = process("a", *STUBBORN, stop=Stop(timeout=600.0))
    with launched(tmp_path, plan(stubborn)) as run:
        run.await_line("a", "up")
        run.send(signal.SIGKILL)
        run.assert_gone(9.0)
