"""Dependencies, readiness, restarts and triggers, with real processes."""

from __future__ import annotations

import signal
from typing import TYPE_CHECKING

import pytest

from orchestra.values import Restart
from tests.supervise.plans import (
    INTERNAL,
    after,
    at_start,
    deferred,
    finished,
    launched,
    log,
    plan,
    process,
    ready_when,
    stand_in,
    start,
    when_ended,
)

if TYPE_CHECKING:
    from pathlib import Path

    from tests.supervise.plans import Launched


def order(run: Launched, *wanted: tuple[str, str]) -> list[tuple[str, str]]:
    return [(e.kind, e.process or "") for e in run.events if (e.kind, e.process) in wanted]


@pytest.mark.parametrize(
    "words",
    [
        ("say=listening on 80", "linger"),
        ("partial=listening on", "linger"),
        ("complain=is listening", "linger"),
    ],
)
def test_a_line_makes_a_process_ready(tmp_path: Path, words: tuple[str, ...]) -> None:
    """A finished line, one without its end, one on standard error."""
    server = process("server", *words, ready=ready_when(r"listening( on)?"))
    client = process("client", "exit=0", required=True, depends_on=after("server", "ready"))
    run = finished(tmp_path, plan(client, server))
    assert run.popen.returncode == 0
    steps = (("process_ready", "server"), ("process_starting", "client"))
    assert order(run, *steps) == list(steps)


def test_each_condition_lets_its_dependent_begin(tmp_path: Path) -> None:
    first = process("first", "exit=0")
    bad = process("bad", "exit=1")
    run = finished(
        tmp_path,
        plan(
            process("on_started", "exit=0", depends_on=after("first", "started")),
            process("on_completed", "exit=0", depends_on=after("first", "completed")),
            process("on_exited", "exit=0", depends_on=after("bad", "exited")),
            process("on_bad_completed", "exit=0", depends_on=after("bad", "completed")),
            process("on_skipped", "exit=0", depends_on=after("on_bad_completed", "exited")),
            first,
            bad,
        ),
    )
    assert run.popen.returncode == 0
    for name, awaited in (("on_completed", "first"), ("on_exited", "bad")):
        steps = (("process_ended", awaited), ("process_starting", name))
        assert order(run, *steps) == list(steps)
    assert run.of_kind("process_exited", "on_started")
    for name in ("on_bad_completed", "on_skipped"):
        assert run.kinds(name) == ["process_waiting", "process_skipped"]
    assert "on_bad_completed is skipped: bad will not be completed any more" in run.stderr


def test_a_timeout_names_what_was_awaited_and_shows_the_last_lines(tmp_path: Path) -> None:
    talking = ("/bin/sh", "-c", "echo opening port; echo port is busy; exec sleep 600")
    server = process("server", command=talking, ready=ready_when("listening"))
    client = process("client", "exit=0", depends_on=after("server", "ready", timeout=1.5))
    run = finished(tmp_path, plan(server, client))
    assert run.popen.returncode == 1
    assert (
        "[orchestra] client waited 1.5 s for server to be ready (a line of its output that matches 'listening')\n"
        "[orchestra] last lines of server:\n"
        "[orchestra]     opening port\n"
        "[orchestra]     port is busy\n"
    ) in run.stderr


def test_an_edge_is_timed_from_the_start_it_follows(tmp_path: Path) -> None:
    """`b` may take its time although `a` took longer than the whole timeout of the edge to `b`."""
    slow = ("/bin/sh", "-c", "sleep 0.8; echo up; sleep 100")
    a = process("a", command=slow, ready=ready_when("up"))
    b = process("b", command=slow, ready=ready_when("up"), depends_on=after("a", "ready"))
    c = process("c", "exit=0", required=True, depends_on=after("b", "ready", timeout=30.0))
    assert finished(tmp_path, plan(a, b, c)).popen.returncode == 0


@pytest.mark.conforms("D30", "4.8 delay")
def test_a_restart_waits_longer_each_time(tmp_path: Path) -> None:
    with launched(tmp_path, plan(process("a", "exit=1", restart=Restart("always")))) as run:
        run.await_event("process_starting", "a", count=3)
        begins = [event.monotonic for event in run.of_kind("process_starting", "a")]
        assert begins[2] - begins[1] >= 1.0
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert run.kinds("a")[-1] == "process_exited"


def test_a_restarted_process_becomes_ready_again(tmp_path: Path) -> None:
    crashing = process("a", "say=up", "exit=1", ready=ready_when("up"), restart=Restart("always", budget=1))
    run = finished(tmp_path, plan(crashing))
    assert run.kinds("a").count("process_ready") == 2


@pytest.mark.conforms("1.3.2 on_exit")
def test_triggers_follow_every_end(tmp_path: Path) -> None:
    again = process("again", "exit=1", restart=Restart("on-failure", budget=1))
    late = process("late", "say=here", "exit=0")
    triggers = (
        when_ended("again", log("again has ended")),
        when_ended("late", log("late has ended")),
        at_start(start("late"), delay=0.1),
    )
    run = finished(tmp_path, plan(again, late, triggers=triggers))
    assert run.stderr.count("again has ended") == 2
    assert run.stderr.count("late has ended") == 1
    assert run.log("late") == "here\n"


def test_a_trigger_may_start_a_process_again_and_again(tmp_path: Path) -> None:
    ping = process(
        "ping", command=("/bin/sh", "-c", "echo x >> count; [ $(wc -l < count) -ge 3 ]"), cwd=str(tmp_path)
    )
    pong = process("pong", "exit=0")
    triggers = (when_ended("ping", start("pong")), when_ended("pong", start("ping")), at_start(start("ping")))
    with launched(tmp_path, plan(ping, pong, triggers=triggers)) as run:
        run.await_event("process_starting", "pong", count=3)
        run.send(signal.SIGINT)
        assert run.wait() == 130


@pytest.mark.conforms("D37")
def test_parameter_files_are_written_where_the_command_names_them(tmp_path: Path) -> None:
    node = process(
        "/robot1/ekf",
        command=("/bin/cat", "${run}/params/robot1.ekf.yaml"),
        name="ekf",
        namespace="/robot1",
        parameters={"rate": 30.0, "frame": "odom"},
        environment={"HERE": "${run}/x"},
    )
    run = finished(
        tmp_path, plan(node, process("show", command=stand_in("show=HERE"), environment={"HERE": "${run}/x"}))
    )
    assert run.log("robot1.ekf") == (run.directory / "params" / "robot1.ekf.yaml").read_text()
    assert "/robot1/ekf:" in run.log("robot1.ekf")
    assert run.log("show") == f"HERE={run.directory}/x\n"


@pytest.mark.conforms("1.3.2 shell")
def test_a_shell_gets_one_line(tmp_path: Path) -> None:
    run = finished(tmp_path, plan(process("a", command=("echo", "$((6*7))", "|", "cat"), shell=True)))  # noqa: S604 - the plan says so
    assert run.log("a") == "42\n"


def test_a_program_gets_default_signals_no_input_and_its_marks(tmp_path: Path) -> None:
    """Although SIGINT was ignored when we were started, as for a job in the background of a script."""
    words = ("disposition", "terminal", "show=ORCHESTRA_PROCESS", "show=PYTHONFAULTHANDLER")
    script = ("/bin/sh", "-c", 'trap "" INT TERM USR1; exec "$@"', "sh")
    run = finished(tmp_path, plan(process("/ns/a", *words)), through=script)
    blocked, ignored, *rest = run.log("ns.a").splitlines()
    assert blocked == "SigBlk:\t0000000000000000"
    # SIGPIPE and SIGXFSZ, which the Python of the stand-in ignores by itself, and what only the C library can use.
    assert int(ignored.split()[1], 16) & ~INTERNAL == 0x1001000
    assert rest == [
        "False False False",
        "ORCHESTRA_PROCESS=/ns/a",
        "PYTHONFAULTHANDLER=1",
    ]


def test_what_nobody_can_carry_out_ends_the_run(tmp_path: Path) -> None:
    """The resolver has ended although a trigger needs it."""
    run = finished(tmp_path, plan(process("a", "linger"), triggers=(at_start(deferred(1)),)))
    assert run.popen.returncode == 1
    assert "by_hand.yaml:1:1: this trigger failed: the resolver" in run.stderr


def test_what_the_user_was_told_is_in_the_events(tmp_path: Path) -> None:
    run = finished(tmp_path, plan(process("a", "exit=3"), triggers=(at_start(log("hello")),)))
    told = [event.data["text"] for event in run.of_kind("message")]
    assert told == [line.removeprefix("[orchestra] ") for line in run.stderr.splitlines()]
    assert "hello" in told
