"""Processes that become ready by what is seen from outside: ports, files, commands, and several at once."""

from __future__ import annotations

import contextlib
import signal
import socket
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.plan.conditions import Ready
from orchestra.values import Restart
from tests.supervise.plans import after, alive, finished, launched, plan, process, stand_in, wait_for

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from orchestra.plan.model import Process
    from tests.supervise.plans import Launched


def ready(timeout: float | None = None, **conditions: Any) -> Ready:
    """Return readiness by conditions, each tried fifty times a second."""
    return Ready(**{"log": None, "message": None, "timeout": timeout, "interval": 0.02, **conditions})


def client(name: str = "server") -> Process:
    """Return a process that begins and ends when another is ready, and the run with it."""
    return process("client", "exit=0", required=True, depends_on=after(name, "ready"))


@contextlib.contextmanager
def closed_port() -> Iterator[socket.socket]:
    """A port that is taken, so that it stays closed until we listen, or who says that he shares it with us."""
    with socket.socket() as opened:
        opened.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
        opened.bind(("127.0.0.1", 0))
        yield opened


def text(run: Launched) -> str:
    """Return what was said, as one line."""
    return " ".join(run.stderr.split())


def test_a_process_becomes_ready_late(tmp_path: Path) -> None:
    with closed_port() as port:
        address = f"127.0.0.1:{port.getsockname()[1]}"
        server = process("server", "linger", ready=ready(tcp=address))
        with launched(tmp_path, plan(server, client())) as run:
            run.await_event("process_running", "server")
            assert not run.of_kind("process_ready")
            port.listen()
            assert run.wait() == 0
    assert f"waiting for server: tcp {address}" in run.stderr


def test_everything_that_is_written_has_to_come_about(tmp_path: Path) -> None:
    """Each alone is not enough, in whatever order they come; what is missing is named."""
    (tmp_path / "third").touch()
    conditions = ready(
        log="up", file=str(tmp_path / "first"), command=("test", "-e", str(tmp_path / "second")), timeout=1.0
    )
    server = process("server", "say=up", "linger", ready=conditions)
    run = finished(tmp_path, plan(server))
    assert run.popen.returncode == 1
    assert "waiting for server: a line of its output that matches 'up', " in run.stderr
    first, second = str(tmp_path / "first"), str(tmp_path / "second")
    assert (
        f"server was not ready within 1 s: waited for the file {first} (it does not exist) and "
        f"the command test -e {second} (exit code 1)"
    ) in text(run)
    (tmp_path / "again").mkdir()
    patient = process("server", "say=up", "linger", ready=replace(conditions, timeout=None))
    with launched(tmp_path / "again", plan(patient, client())) as run:
        run.await_event("process_running", "server")
        (tmp_path / "second").touch()
        (tmp_path / "first").touch()
        assert run.wait() == 0


def test_a_timeout_of_an_edge_names_what_is_missing(tmp_path: Path) -> None:
    with closed_port() as port:
        address = f"localhost:{port.getsockname()[1]}"
        there = str(tmp_path)  # which holds from the first look on
        server = process("server", "linger", ready=ready(tcp=address, file=there))
        waits = process("waits", "exit=0", depends_on=after("server", "ready", timeout=0.5))
        run = finished(tmp_path, plan(server, waits))
    assert run.popen.returncode == 1
    assert f"waits waited 0.5 s for server to be ready (tcp {address} (connection refused))" in text(run)


def test_the_end_of_the_wait_is_the_end_of_its_commands(tmp_path: Path) -> None:
    """One that never ends is under way when the process ends; nobody waits for it, and nothing is left."""
    script = f"trap '' INT TERM; echo $$ > {tmp_path}/pid; sleep 600 & wait"
    server = process("server", "linger", ready=ready(command=("sh", "-c", script)))
    with launched(tmp_path, plan(server)) as run:
        pid = int(wait_for(lambda: (tmp_path / "pid").exists() and (tmp_path / "pid").read_text(), "a start"))
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert not alive(pid)
        assert not run.of_kind("left_behind")
        run.assert_gone()


def test_a_process_that_ends_while_it_is_awaited_is_awaited_anew_with_its_next_start(tmp_path: Path) -> None:
    """Its first run has one of two, the second run the other: both have to come about in one."""
    once = "test -e again && touch second && exec sleep 600; touch again; echo up; exit 1"
    server = process(
        "server",
        command=("sh", "-c", once),
        cwd=str(tmp_path),
        restart=Restart("on-failure"),
        ready=ready(log="up", file="second", timeout=1.5),
    )
    run = finished(tmp_path, plan(server))
    assert run.popen.returncode == 1
    assert [event.kind for event in run.events if event.process == "server"].count("process_running") == 2
    assert not run.of_kind("process_ready")
    assert "was not ready within 1.5 s: waited for a line of its output that matches 'up'" in text(run)


def test_a_process_that_fails_while_it_is_awaited_fails_its_dependents_only(tmp_path: Path) -> None:
    server = process("server", "exit=3", ready=ready(file=str(tmp_path / "never")))
    run = finished(tmp_path, plan(server, process("client", "exit=0", depends_on=after("server", "ready"))))
    assert run.kinds("client") == ["process_waiting", "process_skipped"]
    assert run.popen.returncode == 0
    assert not run.of_kind("process_ready")


def test_commands_run_with_what_the_process_has(tmp_path: Path) -> None:
    (tmp_path / "work").mkdir()
    (tmp_path / "work" / "here").touch()
    test = 'test -e here && test "$OWN" = yes && test "$ORCHESTRA_PROCESS" = server'
    server = process(
        "server",
        "linger",
        cwd=str(tmp_path / "work"),
        environment={"OWN": "yes"},
        ready=ready(command=("sh", "-c", test)),
    )
    run = finished(tmp_path, plan(server, client()))
    assert run.popen.returncode == 0


def test_nothing_is_tried_any_more_once_it_is_ready(tmp_path: Path) -> None:
    """The command counts its own starts."""
    count = f"echo x >> {tmp_path}/count"
    server = process("server", "linger", ready=ready(command=("sh", "-c", count)))
    later = process(
        "later", command=("sh", "-c", "sleep 0.5"), required=True, depends_on=after("server", "ready")
    )
    run = finished(tmp_path, plan(server, later))
    assert run.popen.returncode == 0
    assert (tmp_path / "count").read_text() == "x\n"


def test_a_process_may_be_ready_by_http(tmp_path: Path) -> None:
    script = (
        "import http.server, sys\n"
        "http.server.HTTPServer.allow_reuse_port = True\n"
        "server = http.server.HTTPServer(('127.0.0.1', int(sys.argv[1])), http.server.SimpleHTTPRequestHandler)\n"
        "server.serve_forever()\n"
    )
    with closed_port() as port:
        number = port.getsockname()[1]
        server = process(
            "server",
            command=(*stand_in()[:1], "-c", script, str(number)),
            cwd=str(tmp_path),
            ready=ready(http=f"http://localhost:{number}/", timeout=30.0),
        )
        run = finished(tmp_path, plan(server, client()))
    assert run.popen.returncode == 0
    assert f"waiting for server: http://localhost:{number}/" in run.stderr


def test_a_word_that_no_program_can_be_given_is_a_failure_to_start(tmp_path: Path) -> None:
    run = finished(tmp_path, plan(process("a", "say=\0"), process("b", environment={"A": "\0"})))
    assert run.popen.returncode == 0
    for name in ("a", "b"):
        assert run.kinds(name)[-1] == "process_failed"
        assert f"{name} could not be started: a word of it has a byte that is 0" in run.stderr


@pytest.mark.parametrize("conditions", [{"tcp": "nonsense"}, {"http": "nonsense"}, {"file": "\0"}])
def test_what_can_never_come_about_is_a_timeout_with_a_reason(
    tmp_path: Path, conditions: dict[str, str]
) -> None:
    server = process("server", "linger", ready=ready(timeout=0.3, **conditions))
    run = finished(tmp_path, plan(server))
    assert run.popen.returncode == 1
    assert "was not ready within 0.3 s: waited for" in text(run)
