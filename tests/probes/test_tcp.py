from __future__ import annotations

import contextlib
import socket
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.probes import address, visit
from orchestra.probes.address import Target, known, target
from orchestra.probes.conversation import Conversation
from orchestra.probes.tcp import tcp_probe
from orchestra.supervise.loop import Loop
from tests.probes.sites import place

if TYPE_CHECKING:
    from collections.abc import Iterator


@contextlib.contextmanager
def port(host: str = "127.0.0.1", *, listening: bool = True) -> Iterator[socket.socket]:
    """A port that belongs to us; nobody listens yet, or somebody does."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with socket.socket(family) as opened:
        opened.bind((host, 0))
        if listening:
            opened.listen()
        yield opened


def number(of: socket.socket) -> int:
    found: int = of.getsockname()[1]
    return found


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("127.0.0.1:80", Target("127.0.0.1", 80)),
        ("[::1]:80", Target("::1", 80)),
        (":80", Target("localhost", 80)),
        ("robot.local:11311", Target("robot.local", 11311)),
        ("80", None),
        ("localhost", None),
        ("localhost:", None),
        ("localhost:http", None),
        ("localhost:0", None),
        ("localhost:65536", None),
        ("localhost:²", None),
        ("", None),
    ],
)
def test_targets_are_a_host_and_a_port(text: str, wanted: Target | None) -> None:
    assert target(text) == wanted


def test_only_names_need_a_lookup() -> None:
    assert known(Target("127.0.0.1", 80)) == [(socket.AF_INET, ("127.0.0.1", 80))]
    assert [found[1][0] for found in known(Target("::1", 80)) or ()] == ["::1"]
    assert [found[1][0] for found in known(Target("localhost", 80)) or ()] == ["127.0.0.1", "::1"]
    assert known(Target("robot.local", 80)) is None
    assert known(Target("x" * 70 + ".local", 80)) is None
    assert known(Target("a\0b", 80)) is None


def _has_ipv6() -> bool:
    try:
        with port("::1"):
            return True
    except OSError:
        return False


needs_ipv6 = pytest.mark.skipif(not _has_ipv6(), reason="this machine has no IPv6")


@pytest.mark.parametrize(
    ("host", "written"),
    [
        ("127.0.0.1", "localhost"),
        ("127.0.0.1", "127.0.0.1"),
        pytest.param("::1", "[::1]", marks=needs_ipv6),
    ],
)
def test_a_port_that_accepts(host: str, written: str) -> None:
    with port(host) as server, place() as here:
        probe = tcp_probe(f"{written}:{number(server)}", 0.02)
        here.begin(probe)
        here.holds(probe)
        server.accept()[0].close()


def test_it_is_tried_until_somebody_listens() -> None:
    with port(listening=False) as server, place() as here:
        probe = tcp_probe(f"127.0.0.1:{number(server)}", 0.02)
        here.begin(probe)
        here.until(lambda: "refused" in probe.words, "no refusal")
        assert probe.words == f"tcp 127.0.0.1:{number(server)} (connection refused)"
        server.listen()
        here.holds(probe)


def test_a_refused_port_is_given_up_at_any_time() -> None:
    with port(listening=False) as server, place() as here:
        probe = tcp_probe(f"localhost:{number(server)}", 0.02)
        here.begin(probe)
        probe.end()
        assert here.idle
        here.begin(probe)
        here.fails(probe, f"tcp localhost:{number(server)} (connection refused)")


@pytest.mark.parametrize("order", [1, -1], ids=["last", "first"])
def test_that_there_is_no_ipv6_is_not_what_keeps_it_waiting(
    order: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    unknown = 200  # no machine has such a family of addresses
    with port(listening=False) as server, place() as here:
        found = [(socket.AF_INET, ("127.0.0.1", number(server))), (unknown, ("::1", number(server)))]
        monkeypatch.setattr(address, "known", lambda _goal: found[::order])
        probe = tcp_probe(f"localhost:{number(server)}", 0.02)
        here.begin(probe)
        here.fails(probe, f"tcp localhost:{number(server)} (connection refused)")


def test_a_port_that_drops_what_comes_costs_one_attempt_its_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """The queue of connections is full, so the kernel answers no more."""
    monkeypatch.setattr(visit, "WITHIN", 0.2)
    with port(listening=False) as server, contextlib.ExitStack() as clients, place() as here:
        server.listen(0)
        for _ in range(8):
            client = clients.enter_context(socket.socket())
            client.setblocking(False)
            client.connect_ex(server.getsockname())
        probe = tcp_probe(f"127.0.0.1:{number(server)}", 0.02)
        here.begin(probe)
        here.fails(probe, f"tcp 127.0.0.1:{number(server)} (no answer within 0.2 s)")


def test_names_are_looked_up_by_a_program_of_its_own() -> None:
    """In capitals it is the same name, but none that we know."""
    with port() as server, place() as here:
        probe = tcp_probe(f"LOCALHOST:{number(server)}", 0.02)
        here.begin(probe)
        here.until(lambda: here.trials.alive, "no lookup")
        here.holds(probe)


def test_a_name_that_does_not_exist_is_told() -> None:
    with place() as here:
        probe = tcp_probe("robot.invalid:80", 0.02)
        here.begin(probe)
        here.until(lambda: "robot.invalid: " in probe.words, probe.words)
        assert probe.words.startswith("tcp robot.invalid:80 (exit code 1: robot.invalid: ")
        probe.end()


def test_a_name_is_looked_up_once_for_some_attempts(monkeypatch: pytest.MonkeyPatch) -> None:
    started = []
    with port(listening=False) as server, place() as here:
        probe = tcp_probe(f"LOCALHOST:{number(server)}", 0.02)
        run = here.trials.run

        def counted(*words: Any) -> Any:
            started.append(words)
            return run(*words)

        monkeypatch.setattr(here.trials, "run", counted)
        monkeypatch.setattr(address, "_KEEP", 60.0)
        here.begin(probe)
        here.until(lambda: "refused" in probe.words, "no refusal")
        server.listen()
        here.holds(probe)
        assert len(started) == 1


def test_what_is_no_address_is_told() -> None:
    with place() as here:
        probe = tcp_probe("localhost", 0.02)
        here.begin(probe)
        here.fails(probe, "tcp localhost (not HOST:PORT)")


def test_a_call_that_reaches_itself_is_a_refusal() -> None:
    """Where the kernel chooses the called port as ours, two ends of one socket talk with each other."""
    with socket.socket() as own:
        own.bind(("127.0.0.1", 0))
        own.setblocking(False)
        told: list[str | None] = []
        loop = Loop()
        Conversation(loop, visit._connect(own, own.getsockname()), 10.0, told.append)
        while not told:
            loop.run_once()
        loop.close()
        assert told == ["connection refused"]
