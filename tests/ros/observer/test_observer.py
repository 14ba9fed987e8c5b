"""The observer with real publishers."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from tests.supervise.plans import PROCESSES, after, finished, launched, plan, process, ready_when, wait_for

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from orchestra.plan.model import Process

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
        wait_for(lambda: len(run.everything()) == 3, "keeper, supervisor and node to be alone")
        assert run.popen.poll() is None


@pytest.fixture
def observer() -> Iterator[subprocess.Popen[str]]:
    """An observer without a supervisor."""
    with subprocess.Popen(
        [sys.executable, "-m", "orchestra.ros.observer", str(os.getpid())],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        bufsize=1,
        env={**os.environ, **DOMAIN, "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"},
    ) as popen:
        yield popen
        popen.kill()


def test_it_ends_with_its_input(observer: subprocess.Popen[str]) -> None:
    ask(observer, {"id": "a", "do": "watch", "fact": "message", "topic": "/never"})
    assert observer.stdin
    observer.stdin.close()
    assert observer.wait(30) == 0


def test_it_answers_each_wait_once_and_forgets_what_it_is_told_to(observer: subprocess.Popen[str]) -> None:
    offered = ["/a,RELIABLE,VOLATILE,0", "/b,BEST_EFFORT,VOLATILE,0"]
    environment = {**os.environ, **DOMAIN, "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    command = [sys.executable, str(PROCESSES / "publisher.py"), *offered]
    ask(
        observer,
        {"id": "no", "do": "watch", "fact": "message", "topic": "/a"},
        {"forget": "no"},
        {"id": "a", "do": "watch", "fact": "message", "topic": "/a"},
        {"id": "b", "do": "watch", "fact": "message", "topic": "/b"},
    )
    with subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL) as node:
        assert observer.stdout
        answers = [json.loads(observer.stdout.readline()) for _ in range(2)]
        node.terminate()
    assert sorted(answer["id"] for answer in answers) == ["a", "b"]
    assert {answer["say"] for answer in answers} == {"done"}


def ask(observer: subprocess.Popen[str], *requests: dict[str, str]) -> None:
    assert observer.stdin
    for request in requests:
        observer.stdin.write(json.dumps(request) + "\n")


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
