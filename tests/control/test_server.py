"""The control socket of real runs: what it answers, and what no client can do to it."""

from __future__ import annotations

import json
import os
import select
import signal
import socket
import stat
import subprocess
import sys
import time
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.control import door, protocol
from orchestra.control.client import Client, GoneError
from orchestra.control.outlet import BACKLOG
from orchestra.control.protocol import LONGEST_REQUEST, Refusal
from orchestra.control.server import MOST_CLIENTS, Server
from orchestra.supervise.loop import Loop
from orchestra.supervise.options import RunOptions
from orchestra.supervise.resolver import document
from tests.supervise.plans import PATIENCE, PROCESSES, launched, plan, process, ready_when, wait_for

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from tests.supervise.plans import Launched

STEADY = ("polite", "say=up", "linger")


@contextmanager
def _running(folder: Path, *processes: Any, **environment: str) -> Iterator[Launched]:
    """Run processes with a runtime folder of their own, whose path is longer than a socket's may be."""
    runtime = folder / ("r" * 120)
    runtime.mkdir()
    with launched(
        folder, plan(*processes), environment={"XDG_RUNTIME_DIR": str(runtime), **environment}
    ) as run:
        run.await_event("process_running", processes[0].id)
        yield run


@pytest.fixture(scope="module")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Launched]:
    """A run for the tests that leave it as it is."""
    folder = tmp_path_factory.mktemp("shared")
    processes = [process(name, *STEADY) for name in ("/robot1/ekf", "/robot1/arm", "/robot2/ekf", "bag")]
    with _running(folder, *processes) as run:
        for one in processes:
            run.await_event("process_running", one.id)
        yield run
        run.send(signal.SIGINT)
        assert run.wait() == 130


def _connected(run: Launched) -> socket.socket:
    path = door.linked(run.directory)
    assert path is not None
    connection = door.connect(path)
    connection.settimeout(PATIENCE)
    return connection


def _lines(connection: socket.socket) -> Iterator[dict[str, Any]]:
    with connection.makefile("rb") as lines:
        for line in lines:
            yield json.loads(line)


def _phases(client: Client) -> dict[str, str]:
    return {one["id"]: one["phase"] for one in client.ask("snapshot")["processes"]}


def test_the_socket_is_the_owner_s_alone_and_goes_with_the_run(tmp_path: Path) -> None:
    with _running(tmp_path, process("a", *STEADY)) as run:
        path = door.linked(run.directory)
        assert path is not None
        assert len(path) > 108
        facts = os.lstat(path)
        assert stat.S_ISSOCK(facts.st_mode)
        assert stat.S_IMODE(facts.st_mode) == 0o600
        folder = os.lstat(os.path.dirname(path))  # noqa: PTH120
        assert stat.S_IMODE(folder.st_mode) == 0o700
        run.send(signal.SIGINT)
        run.wait()
        assert not os.path.lexists(path)


def test_a_run_says_who_it_is_first(shared: Launched) -> None:
    with _connected(shared) as connection:
        hello = next(_lines(connection))
    assert hello["protocol"] == protocol.VERSION
    assert hello["directory"] == str(shared.directory)
    assert hello["keeper"] == shared.popen.pid
    assert hello["supervisor"] == shared.own("orc-supervisor")
    assert hello["run"].endswith(f"-{shared.popen.pid}")
    assert hello["name"] == "run"


def test_a_snapshot_has_every_process(shared: Launched) -> None:
    with Client(shared.directory) as client:
        found = client.ask("snapshot")
    assert [one["id"] for one in found["processes"]] == ["/robot1/ekf", "/robot1/arm", "/robot2/ekf", "bag"]
    assert found["ending"] is False
    first = found["processes"][0]
    assert first["name"] == "robot1/ekf"
    assert first["phase"] == "running"
    assert first["starts"] == 1
    assert first["uptime"] > 0
    assert first["pid"] == shared.of_kind("process_running", "/robot1/ekf")[0].pid


@pytest.mark.parametrize(
    ("line", "code", "words"),
    [
        (b"hello", "malformed", "JSON"),
        (b"[]", "malformed", "request"),
        (b'"snapshot"', "malformed", "request"),
        (b"{}", "malformed", "request"),
        (b'{"request": 1}', "malformed", "request"),
        (b"\xff\xfe\x00", "malformed", "JSON"),
        (b"[" * 60000, "malformed", "JSON"),
        (b'{"request": "snapshto"}', "unknown_request", "did you mean 'snapshot'"),
        (b'{"request": "stop"}', "malformed", "processes"),
        (b'{"request": "stop", "processes": "bag"}', "malformed", "processes"),
        (b'{"request": "stop", "processes": [1]}', "malformed", "texts"),
        (b'{"request": "stop", "processes": [""]}', "malformed", "texts"),
        (b'{"request": "stop", "processes": ["robot1/efk"]}', "unknown_process", "'robot1/ekf'"),
        (b'{"request": "signal", "processes": ["bag"]}', "unknown_signal", "None"),
        (b'{"request": "signal", "processes": ["bag"], "signal": "USR9"}', "unknown_signal", "USR9"),
        (b'{"request": "signal", "processes": ["bag"], "signal": 1000}', "unknown_signal", "1000"),
        (b'{"request": "signal", "processes": ["bag"], "signal": true}', "unknown_signal", "True"),
        (b'{"request": "signal", "processes": ["bag"], "signal": []}', "unknown_signal", "[]"),
    ],
)
def test_what_is_no_request_is_answered_as_that(shared: Launched, line: bytes, code: str, words: str) -> None:
    with _connected(shared) as connection:
        lines = _lines(connection)
        next(lines)
        connection.sendall(line + b"\n")
        answer = next(lines)
        assert answer["error"]["code"] == code
        assert words in answer["error"]["message"]
        connection.sendall(b'{"id": ["any"], "request": "snapshot"}\n')
        assert next(lines)["id"] == ["any"]


def test_a_line_that_is_too_long_ends_the_connection_and_nothing_else(shared: Launched) -> None:
    with _connected(shared) as connection, Client(shared.directory) as other:
        lines = _lines(connection)
        next(lines)
        connection.sendall(b"x" * LONGEST_REQUEST)
        connection.sendall(b'{"id": 1}'.rjust(10))
        assert next(lines)["error"]["code"] == "oversized"
        assert not list(lines)
        assert len(_phases(other)) == 4


def test_the_longest_line_is_read(shared: Launched) -> None:
    with _connected(shared) as connection:
        lines = _lines(connection)
        next(lines)
        request = b'{"request": "snapshot", "id": "%s"}'
        padding = b"x" * (LONGEST_REQUEST - len(request) + 2)
        for piece in (request[:20], request[20:] % padding, b"\n"):
            connection.sendall(piece)
        assert next(lines)["id"] == padding.decode()


def test_lines_may_come_in_pieces_and_many_at_once(shared: Launched) -> None:
    with _connected(shared) as connection:
        lines = _lines(connection)
        next(lines)
        text = b"".join(b'{"id": %d, "request": "snapshot"}\n\n' % number for number in range(50))
        for begin in range(0, len(text), 7):
            connection.sendall(text[begin : begin + 7])
        assert [next(lines)["id"] for _ in range(50)] == list(range(50))


def test_a_line_that_is_cut_off_is_none(shared: Launched) -> None:
    with _connected(shared) as connection:
        lines = _lines(connection)
        next(lines)
        connection.sendall(b'{"id": 1, "request": "snapshot"}\n{"id": 2, "request": "do')
        connection.shutdown(socket.SHUT_WR)
        first, second = lines
        assert first["id"] == 1
        assert second["error"]["code"] == "malformed"


@given(st.lists(st.binary(max_size=200) | st.text(max_size=50).map(str.encode), max_size=20))
@settings(max_examples=60, deadline=None, suppress_health_check=list(HealthCheck))
def test_garbage_harms_nobody(shared: Launched, pieces: list[bytes]) -> None:
    with _connected(shared) as connection, Client(shared.directory) as other:
        for piece in pieces:
            connection.sendall(piece)
        connection.sendall(b"\n")
        assert set(_phases(other).values()) == {"running"}


_VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(max_size=10),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=5,
)


@given(
    st.sampled_from(["snapshot", "subscribe", "start", "restart", "signal"]),
    st.dictionaries(st.sampled_from(["wait", "signal", "id", "x"]), _VALUES),
    _VALUES,
)
@settings(max_examples=60, deadline=None, suppress_health_check=list(HealthCheck))
def test_requests_with_any_values_are_answered(
    shared: Launched, name: str, given_values: dict[str, Any], processes: Any
) -> None:
    wanted = "nobody" if name in ("start", "restart", "signal") else name
    with Client(shared.directory) as client:
        document = {"processes": [wanted, processes], **given_values, "id": 1, "request": name}
        client._connection.sendall(json.dumps(document).encode() + b"\n")
        message = next(client.messages())
    assert message.get("error", {}).get("code") != "bug"
    assert "result" in message or message["error"]["code"] in (
        *("malformed", "unknown_process", "unknown_signal"),
    )


def test_a_hundred_clients_are_served(shared: Launched) -> None:
    with ExitStack() as opened:
        clients = [opened.enter_context(Client(shared.directory)) for _ in range(100)]
        numbers = [client.send("snapshot") for client in clients]
        for client, number in zip(clients, numbers, strict=True):
            message = next(client.messages())
            assert message["id"] == number
            assert len(message["result"]["processes"]) == 4


def test_one_client_too_many_is_told_so_and_has_a_place_when_another_has_gone(shared: Launched) -> None:
    with ExitStack() as opened:
        first = opened.enter_context(Client(shared.directory))
        for _ in range(MOST_CLIENTS - 1):
            opened.enter_context(Client(shared.directory))
        with pytest.raises(Refusal, match="128 clients") as caught:
            Client(shared.directory)
        assert caught.value.code == "busy"
        first.close()

        def place() -> bool:
            try:
                Client(shared.directory).close()
            except Refusal:
                return False
            return True

        wait_for(place, "a free place")


def test_a_client_that_has_hung_up_takes_no_place() -> None:
    """The kernel may tell of a new client before it tells that others have gone."""
    listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM | socket.SOCK_NONBLOCK)
    listener.bind("")  # an abstract name, by the kernel's choice (unix(7))
    listener.listen(MOST_CLIENTS)
    loop = Loop()
    server = Server(loop, listener, {}, lambda _guest, _request: None)

    def entering() -> socket.socket:
        client = socket.socket(socket.AF_UNIX)
        client.connect(listener.getsockname())
        return client

    clients = [entering() for _ in range(MOST_CLIENTS)]
    while server.clients < MOST_CLIENTS:
        server._accept()
    clients.pop().close()
    with entering() as late, entering() as too_late:
        server._accept()
        assert json.loads(late.recv(4096)) == {}
        assert json.loads(too_late.recv(4096))["error"]["code"] == "busy"
        for client in clients:
            client.close()
        server.close()
    loop.close()


def test_events_follow_the_snapshot_without_gap_or_repetition(shared: Launched) -> None:
    """Two threads of events: one client causes them while others subscribe in the middle of it."""
    with Client(shared.directory) as cause, ExitStack() as opened:
        listeners = []
        for _ in range(10):
            for _ in range(10):
                cause.send("signal", processes=["bag"], signal="SIGURG")
            listener = opened.enter_context(Client(shared.directory))
            listeners.append((listener, listener.ask("subscribe")["events"]))
        for _ in range(100):
            next(cause.messages())
        written = shared.events
        for listener, count in listeners:
            heard = listener.messages()
            for number, event in enumerate(written[count:], count + 1):
                message = next(heard)
                assert message["number"] == number
                assert message["event"]["kind"] == event.kind
                assert message["event"]["monotonic"] == event.monotonic


def test_a_client_that_never_reads_is_dropped_and_others_miss_nothing(shared: Launched) -> None:
    with _connected(shared) as mute, Client(shared.directory) as cause, Client(shared.directory) as reader:
        mute.sendall(b'{"id": 1, "request": "subscribe"}\n')
        count = reader.ask("subscribe")["events"]
        heard = reader.messages()
        total = 0
        while not _hung_up(mute):
            for _ in range(100):
                cause.send("signal", processes=["*"], signal="SIGURG")
            for _ in range(100):
                assert "result" in next(cause.messages())
            for _ in range(400):
                total += 1
                assert next(heard)["number"] == count + total
        assert set(_phases(cause).values()) == {"running"}
        left = b"".join(iter(lambda: mute.recv(1 << 20), b""))
        assert len(left) < BACKLOG  # what the kernel had for it: all the rest was never kept


def _hung_up(connection: socket.socket) -> bool:
    poll = select.poll()
    poll.register(connection, select.POLLHUP)
    return bool(poll.poll(0))


def test_a_client_that_asks_without_reading_is_dropped(shared: Launched) -> None:
    with _connected(shared) as mute, Client(shared.directory) as other:
        mute.setblocking(False)
        deadline = time.monotonic() + PATIENCE
        request = b'{"request": "snapshot"}\n' * 100
        while not _hung_up(mute):
            assert time.monotonic() < deadline
            try:
                mute.send(request)
            except BlockingIOError:
                select.select([], [mute], [], 0.1)
            except (BrokenPipeError, ConnectionResetError):
                break
        assert len(_phases(other)) == 4


def test_processes_are_stopped_started_and_restarted(tmp_path: Path) -> None:
    ready = process("/b", "say=up", "linger", ready=ready_when(log="up"))
    with _running(tmp_path, process("/a", *STEADY), ready) as run, Client(run.directory) as client:
        run.await_line("a", "up")
        stopped = client.ask("stop", processes=["a"])
        assert stopped["refused"] == {}
        assert stopped["processes"]["/a"]["phase"] == "exited"
        assert client.ask("stop", processes=["a"]) == {"refused": {"/a": "it does not run"}, "processes": {}}
        started = client.ask("start", processes=["/a"])["processes"]["/a"]
        assert (started["phase"], started["starts"]) == ("running", 2)
        again = client.ask("restart", processes=["*"])["processes"]
        assert {name: (one["phase"], one["starts"]) for name, one in again.items()} == {
            "/a": ("running", 3),
            "/b": ("ready", 2),
        }
        assert client.ask("stop", processes=["a"], wait=False)["processes"]["/a"]["phase"] == "stopping"
        run.await_event("process_exited", "/a", 2)
        assert client.ask("signal", processes=["b"], signal="USR1")["refused"] == {}
        run.await_event("process_failed", "/b")
        client.ask("down")
        assert [one for one in client.messages() if "event" in one] == []
        run.wait()


def test_the_last_event_reaches_who_listens(tmp_path: Path) -> None:
    with _running(tmp_path, process("/a", *STEADY)) as run, Client(run.directory) as client:
        client.ask("subscribe")
        client.ask("down", reason="enough of it")
        *_, last = client.messages()
        assert last["event"]["kind"] == "run_ended"
        assert last["event"]["data"]["status"] == run.wait()
        assert last["event"]["data"]["reason"] == run.events[-1].data["reason"]
        assert "enough of it" in last["event"]["data"]["reason"]


def test_who_waits_for_a_process_hears_of_its_end_when_the_run_ends(tmp_path: Path) -> None:
    never = process("/a", "say=up", "linger", ready=ready_when(log="never"))
    with _running(tmp_path, never) as run, Client(run.directory) as client, Client(run.directory) as other:
        run.await_line("a", "up")
        client.send("restart", processes=["a"])
        run.await_event("process_running", "/a", 2)
        other.ask("down")
        (answer,) = client.messages()
        assert answer["result"]["processes"]["/a"]["phase"] == "exited"
        run.wait()


def test_a_supervisor_without_descriptors_sends_clients_away_and_goes_on(tmp_path: Path) -> None:
    limited = ("sh", "-c", 'ulimit -n 64; exec "$@"', "sh")
    runtime = tmp_path / "runtime"
    runtime.mkdir()
    environment = {"XDG_RUNTIME_DIR": str(runtime)}
    what = plan(process("/a", *STEADY))
    with launched(tmp_path, what, environment=environment, through=limited) as run, ExitStack() as opened:
        run.await_event("process_running", "/a")
        refused = None
        clients = []
        while refused is None:
            try:
                clients.append(opened.enter_context(Client(run.directory)))
            except Refusal as why:
                refused = why
            assert len(clients) < 64
        assert refused.code == "busy"
        assert "descriptor" in str(refused)
        assert _phases(clients[0]) == {"/a": "running"}
        clients.pop().close()
        wait_for(lambda: _can_enter(run), "a free place")
        clients.append(opened.enter_context(Client(run.directory)))
        run.send(signal.SIGINT)
        assert run.wait() == 130, "what stops processes needs descriptors, too"


def _can_enter(run: Launched) -> bool:
    try:
        with Client(run.directory) as client:
            return bool(_phases(client))
    except (Refusal, GoneError):
        return False


def test_where_the_runtime_folder_is_of_no_use_the_socket_is_in_another(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    for runtime in (tmp_path / "file", tmp_path / "none", "relative"):
        folder = tmp_path / f"run-{os.path.basename(runtime)}"  # noqa: PTH119 - it may be relative
        folder.mkdir()
        what = plan(process("/a", *STEADY))
        with launched(folder, what, environment={"XDG_RUNTIME_DIR": str(runtime)}) as run:
            run.await_event("process_running", "/a")
            path = door.linked(run.directory)
            assert path is not None
            assert path.startswith(f"/tmp/orchestra-{os.getuid()}/")  # noqa: S108
            with Client(run.directory) as client:
                client.ask("down")
            run.wait()
        assert not os.path.lexists(path)


def test_a_run_for_whose_socket_there_is_no_place_runs_all_the_same(tmp_path: Path) -> None:
    document_ = tmp_path / "document.json"
    document_.write_bytes(document.dumps(plan(process("/a", "say=up", "exit=0")), RunOptions()))
    done = subprocess.run(
        [sys.executable, PROCESSES / "placeless.py", document_, tmp_path / "no" / "place"],
        env={**os.environ, "ORCHESTRA_HOME": str(tmp_path / "home")},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    assert done.returncode == 0
    assert "this run cannot be controlled: No such file or directory" in done.stderr
    assert "up" in done.stdout
