"""The observer with real publishers."""

from __future__ import annotations

import os
import signal
import sys
from typing import TYPE_CHECKING

import pytest

from orchestra.plan.conditions import Alive
from tests.ros.observer.conversation import Domain, graph_node, observing
from tests.supervise.plans import (
    PATIENCE,
    PROCESSES,
    after,
    finished,
    launched,
    plan,
    process,
    ready_when,
    wait_for,
)

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Process
    from tests.supervise.plans import Launched

DOMAIN = {"ROS_DOMAIN_ID": "30"}


def publisher(*words: str, **changes: object) -> Process:
    command = (sys.executable, str(PROCESSES / "publisher.py"), *words)
    return process("publisher", command=command, **changes)


@pytest.mark.parametrize(
    "offered",
    [
        ("/chat,RELIABLE,VOLATILE,0",),
        ("/chat,BEST_EFFORT,VOLATILE,0",),
        ("/chat,RELIABLE,TRANSIENT_LOCAL,1",),
        # The one that speaks offers less than the one that is silent.
        ("/chat,RELIABLE,TRANSIENT_LOCAL,-", "/chat,BEST_EFFORT,VOLATILE,0"),
    ],
)
def test_the_first_message_makes_a_process_ready(tmp_path: Path, offered: tuple[str, ...]) -> None:
    node = publisher(*offered, ready=ready_when(message="/chat", timeout=60.0))
    after_it = process("client", "exit=0", required=True, depends_on=after("publisher", "ready"))
    run = finished(tmp_path, plan(node, after_it), environment=DOMAIN)
    assert run.popen.returncode == 0
    assert run.of_kind("process_ready", "publisher")


def test_a_publisher_that_is_silent_is_not_ready(tmp_path: Path) -> None:
    node = publisher("/chat,RELIABLE,VOLATILE,-", ready=ready_when(message="/chat", timeout=4.0))
    run = finished(tmp_path, plan(node), environment=DOMAIN)
    assert run.popen.returncode == 1
    assert "publisher was not ready within 4 s: waited for a message on /chat" in run.stderr


def test_a_node_in_another_domain_is_seen_there(tmp_path: Path) -> None:
    there: dict[str, str | None] = {"ROS_DOMAIN_ID": "31"}
    node = publisher(
        "/chat,RELIABLE,VOLATILE,0", ready=ready_when(message="/chat", timeout=60.0), environment=there
    )
    after_it = process("client", "exit=0", required=True, depends_on=after("publisher", "ready"))
    assert finished(tmp_path, plan(node, after_it), environment=DOMAIN).popen.returncode == 0


def test_it_is_gone_after_the_last_wait(tmp_path: Path) -> None:
    node = publisher("/chat,RELIABLE,VOLATILE,0", ready=ready_when(message="/chat", timeout=60.0))
    with launched(tmp_path, plan(node), environment=DOMAIN) as run:
        run.await_event("process_ready", "publisher")
        wait_for(lambda: len(run.everything()) == 4, "keeper, guard, supervisor and node to be alone")
        assert run.popen.poll() is None


def test_it_ends_with_its_input_whatever_is_awaited(tmp_path: Path) -> None:
    with observing(Domain(30, tmp_path)) as observer:
        observer.watch("a", "message", topic="/never")
        observer.caught_up()
        assert observer.popen.stdin
        observer.popen.stdin.close()
        assert observer.popen.wait(PATIENCE) == 0


def test_it_answers_each_wait_once_and_forgets_what_it_is_told_to(tmp_path: Path) -> None:
    domain = Domain(30, tmp_path)
    with observing(domain) as observer:
        observer.watch("no", "message", topic="/a")
        observer.forget("no")
        observer.watch("a", "message", topic="/a")
        observer.watch("b", "message", topic="/b")
        with graph_node(domain, "/talker") as talker:
            talker.do("topic /a", "topic /b")
            for name in ("a", "b"):
                observer.said(name, "done")
            observer.watch("more", "message", topic="/a")
            observer.said("more", "done")
        assert [len(observer.heard(name)) for name in ("no", "a", "b")] == [0, 1, 1]


def test_files_in_the_working_directory_are_not_taken_for_modules(tmp_path: Path) -> None:
    folder = tmp_path / "work"
    folder.mkdir()
    for name in ("json", "rclpy", "orchestra"):
        (folder / f"{name}.py").write_text("raise SystemExit('the wrong module')")
    node = publisher(
        "/chat,RELIABLE,VOLATILE,0", ready=ready_when(message="/chat", timeout=60.0), required=True
    )
    with launched(tmp_path, plan(node), environment=DOMAIN, cwd=folder) as run:
        run.await_event("process_ready", "publisher")


def test_an_observer_that_is_killed_is_replaced_and_the_wait_goes_on(tmp_path: Path) -> None:
    go = tmp_path / "go"
    script = 'while [ ! -e "$0" ]; do sleep 0.05; done; exec "$@"'
    talk = (sys.executable, str(PROCESSES / "publisher.py"), "/chat,RELIABLE,VOLATILE,0")
    node = process(
        "publisher",
        command=("/bin/sh", "-c", script, str(go), *talk),
        ready=ready_when(message="/chat", timeout=60.0),
    )
    with launched(tmp_path, plan(node), environment=DOMAIN) as run:
        replaced(run)
        go.touch()
        run.await_event("process_ready", "publisher")


def test_without_any_observer_the_wait_fails_and_says_why(tmp_path: Path) -> None:
    node = publisher("/chat,RELIABLE,VOLATILE,-", ready=ready_when(message="/chat"))
    with launched(tmp_path, plan(node), environment=DOMAIN) as run:
        replaced(run)
        os.kill(run.own("orc-observer"), signal.SIGKILL)
        assert run.wait() == 1
    assert (
        "cannot tell whether publisher is ready: the observer, which looks into the ROS graph, "
        "ended (SIGKILL), and so did the one before"
    ) in run.stderr


def test_an_observer_that_is_killed_is_not_taken_for_a_hung_node(tmp_path: Path) -> None:
    """It hangs when it has published for 6 s, not when nobody can see that it does."""
    alive = Alive(message="/chat", window=2.0)
    node = publisher("/chat,RELIABLE,VOLATILE,60", ready=ready_when(message="/chat"), alive=alive)
    with launched(tmp_path, plan(node), environment=DOMAIN) as run:
        ready = run.await_event("process_ready", "publisher")
        replaced(run)
        hung = run.await_event("process_hung", "publisher")
        assert hung.monotonic - ready.monotonic > 5.0
        wait_for(lambda: "no message on /chat for 2 s" in run.stderr, "the reason")
        run.send(signal.SIGINT)
        run.wait()
        assert not run.everything()


def replaced(run: Launched) -> None:
    """Kill the observer of a run and wait for the next one."""
    first = run.own("orc-observer")
    os.kill(first, signal.SIGKILL)
    wait_for(lambda: run.own("orc-observer") != first, "another observer")
    told = "observer: ended (SIGKILL); it is started again"
    wait_for(lambda: told in run.stderr, told)
