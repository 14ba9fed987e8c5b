"""We ourselves as a service: a real datagram socket stands for the service manager."""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
from configparser import ConfigParser
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.environment import Host, node_environment
from orchestra.supervise.loop import Loop
from orchestra.supervise.process.life import Phase, State
from orchestra.supervise.service_manager import ServiceManager, settled, status
from orchestra.supervise.summons import PERSONAL, Summons, taken
from orchestra.values import Restart, Stop
from tests.supervise.plans import (
    PATIENCE,
    after,
    finished,
    launched,
    plan,
    process,
    start,
    wait_for,
    when_ended,
)
from tests.supervise.test_readiness import ready

if TYPE_CHECKING:
    from collections.abc import Iterator


class Manager:
    """What systemd does: it listens, and keeps who said what."""

    def __init__(self, address: str) -> None:
        self.variable = address
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_PASSCRED, 1)
        self._socket.settimeout(0.1)
        self._socket.bind(f"\0{address[1:]}" if address.startswith("@") else address)
        self.senders: set[int] = set()
        self.messages: list[list[str]] = []
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._listen)

    def listen(self) -> None:
        """Begin to read."""
        self._thread.start()

    def close(self) -> None:
        self._over.set()
        if self._thread.is_alive():
            self._thread.join()
        self._socket.close()

    @property
    def said(self) -> list[str]:
        """Everything that was said, in order, but the signs of life."""
        return [line for message in self.messages for line in message if line != "WATCHDOG=1"]

    @property
    def beats(self) -> int:
        """How often it was said that we live."""
        return [line for message in self.messages for line in message].count("WATCHDOG=1")

    def await_line(self, line: str) -> None:
        wait_for(lambda: line in self.said, f"{line} in {self.said}")

    def _listen(self) -> None:
        while not self._over.is_set():
            with contextlib.suppress(TimeoutError):
                data, ancillary, _, _ = self._socket.recvmsg(65536, 1024)
                self.senders.add(struct.unpack("iII", ancillary[0][2])[0])
                self.messages.append(data.decode().split("\n"))


@contextlib.contextmanager
def manager(address: str, *, listening: bool = True) -> Iterator[Manager]:
    opened = Manager(address)
    if listening:
        opened.listen()
    try:
        yield opened
    finally:
        opened.close()


@pytest.mark.parametrize("kind", ["file", "abstract"])
def test_it_hears_of_a_run_from_its_beginning_to_its_end(tmp_path: Path, kind: str) -> None:
    go = tmp_path / "go"
    server = process("server", "linger", ready=ready(file=str(go)))
    client = process("client", "linger", depends_on=after("server", "ready"))
    address = str(tmp_path / "notify") if kind == "file" else f"@orchestra-test-{os.getpid()}"
    environment = {"NOTIFY_SOCKET": address}
    with (
        manager(address) as service,
        launched(tmp_path, plan(server, client), environment=environment) as run,
    ):
        absent = f"server (the file {go} (it does not exist))"
        service.await_line(f"STATUS=1 of 2 running; waiting for {absent}, client")
        assert "READY=1" not in service.said
        supervisor = run.own("orc-supervisor")
        go.touch()
        service.await_line("READY=1")
        service.await_line("STATUS=2 of 2 running")
        run.send(signal.SIGTERM)
        assert run.wait() == 143
        service.await_line("STATUS=ended with status 143: stopped by SIGTERM")
        assert service.senders == {supervisor}
    said = service.said
    assert said[0] == "STATUS=reading the description"
    assert said.count("READY=1") == said.count("STOPPING=1") == 1
    assert said.index("READY=1") < said.index("STOPPING=1")
    (asked,) = [line for line in said if line.startswith("EXTEND_TIMEOUT_USEC=")]
    assert 9e6 < int(asked.partition("=")[2]) <= 10e6
    assert service.beats == 0


def test_a_long_stop_is_asked_for(tmp_path: Path) -> None:
    address = str(tmp_path / "notify")
    slow = process("slow", "polite", "say=up", "linger", stop=Stop(timeout=30.0))
    with (
        manager(address) as service,
        launched(tmp_path, plan(slow), environment={"NOTIFY_SOCKET": address}) as run,
    ):
        run.await_line("slow", "up")
        run.send(signal.SIGTERM)
        run.wait()
        wait_for(lambda: any(line.startswith("EXTEND") for line in service.said), "the wish for time")
    (asked,) = [line for line in service.said if line.startswith("EXTEND_TIMEOUT_USEC=")]
    assert int(asked.partition("=")[2]) > 35e6


def test_what_need_not_come_is_not_waited_for(tmp_path: Path) -> None:
    """One fails before it is ready, one is skipped for that, one only a trigger starts, one is done."""
    failing = process("failing", "exit=3", ready=ready(file=str(tmp_path / "never")))
    skipped = process("skipped", "linger", depends_on=after("failing", "ready"))
    held = process("held", "linger")
    done = process("done", "exit=0")
    works = process("works", "linger", restart=Restart("on-failure"))
    address = str(tmp_path / "notify")
    never = when_ended("works", start("held"))
    with (
        manager(address) as service,
        launched(
            tmp_path,
            plan(failing, skipped, held, done, works, triggers=(never,)),
            environment={"NOTIFY_SOCKET": address},
        ) as run,
    ):
        service.await_line("READY=1")
        service.await_line("STATUS=1 of 5 running; failed failing")
        run.send(signal.SIGINT)
        run.wait()


def test_a_run_that_fails_is_never_ready(tmp_path: Path) -> None:
    address = str(tmp_path / "notify")
    server = process("server", "linger", ready=ready(file=str(tmp_path / "never"), timeout=0.3))
    with manager(address) as service:
        run = finished(tmp_path, plan(server), environment={"NOTIFY_SOCKET": address})
        assert run.popen.returncode == 1
        wait_for(lambda: "STOPPING=1" in service.said, "the end")
    assert "READY=1" not in service.said


def test_it_hears_that_we_live_and_that_we_do_not(tmp_path: Path) -> None:
    """The pid for which the sign is meant is that of the keeper, which the service manager has started."""
    address = str(tmp_path / "notify")
    environment = {"NOTIFY_SOCKET": address, "WATCHDOG_USEC": "400000"}
    begun = time.monotonic()
    through = ("sh", "-c", 'export WATCHDOG_PID=$$; exec "$@"', "sh")
    with (
        manager(address) as service,
        launched(tmp_path, plan(process("a", "linger")), environment=environment, through=through) as run,
    ):
        service.await_line("READY=1")
        before = service.beats
        wait_for(lambda: service.beats >= before + 5, "signs of life")
        supervisor = run.own("orc-supervisor")
        os.kill(supervisor, signal.SIGSTOP)
        wait_for(
            lambda: Path(f"/proc/{supervisor}/stat").read_text().rpartition(")")[2].split()[0] == "T",
            "its stop",
        )
        silent = wait_for(lambda: _silence(service), "silence")
        assert silent
        os.kill(supervisor, signal.SIGCONT)
        now = service.beats
        wait_for(lambda: service.beats > now, "a sign of life")
        run.send(signal.SIGTERM)
        assert run.wait() == 143
        assert service.beats <= (time.monotonic() - begun) / 0.2 + 1
        assert service.said.count("READY=1") == 1


def _silence(service: Manager) -> bool:
    """Tell whether nothing comes for as long as two signs should take, and more."""
    before = service.beats
    time.sleep(1.0)
    return service.beats == before


def test_a_service_manager_that_is_busy_hears_the_newest_later(tmp_path: Path) -> None:
    """It reads nothing until the run has gone on for long: nobody waits for it."""
    address = str(tmp_path / "notify")
    loop = Loop()
    with manager(address, listening=False) as service:
        ours = ServiceManager(loop, Summons(address), pytest.fail)
        for number in range(20000):
            ours._tell(STATUS=f"number {number}")
            if ours._waiting:
                break
        assert ours._waiting, "the queue has no end"
        ours._tell(READY="1", STATUS="the newest")
        service.listen()
        deadline = time.monotonic() + PATIENCE
        while ours._waiting and time.monotonic() < deadline:
            loop.run_once()
        wait_for(lambda: service.messages and "READY=1" in service.messages[-1], "the last message")
        assert sorted(service.messages[-1]) == ["READY=1", "STATUS=the newest"]
        ours.close()
    loop.close()


@pytest.mark.parametrize(
    ("address", "told"),
    [
        ("{folder}/nobody", "the service manager is not told anything more: No such file or directory"),
        ("vsock:2:1", "the service manager is not told anything: NOTIFY_SOCKET=vsock:2:1 is no unix socket"),
        ("", None),
    ],
)
def test_a_run_goes_on_where_nobody_listens(tmp_path: Path, address: str, told: str | None) -> None:
    environment = {"NOTIFY_SOCKET": address.format(folder=tmp_path), "WATCHDOG_USEC": "100000"}
    run = finished(tmp_path, plan(process("a", "exit=0")), environment=environment)
    assert run.popen.returncode == 0
    assert run.stderr.count("service manager") == (0 if told is None else 1)
    assert told is None or told in run.stderr


def test_launch_files_do_not_see_it(tmp_path: Path) -> None:
    address = str(tmp_path / "notify")
    (tmp_path / "it.launch.yaml").write_text(
        "launch:\n- executable: {cmd: 'echo $(env NOTIFY_SOCKET none)', output: screen, name: it}\n"
    )
    with manager(address) as service:
        run = subprocess.run(
            [sys.executable, "-m", "orchestra", "launch", str(tmp_path / "it.launch.yaml")],
            env={**os.environ, "ORCHESTRA_HOME": str(tmp_path), "NOTIFY_SOCKET": address},
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            check=True,
        )
        service.await_line("READY=1")
    assert "none" in run.stdout
    assert address not in run.stdout


@pytest.mark.parametrize(
    ("environment", "wanted"),
    [
        ({}, (None, None)),
        ({"NOTIFY_SOCKET": "/a"}, ("/a", None)),
        ({"NOTIFY_SOCKET": "/a", "WATCHDOG_USEC": "500000"}, ("/a", 0.5)),
        ({"NOTIFY_SOCKET": "/a", "WATCHDOG_USEC": "500000", "WATCHDOG_PID": "7"}, ("/a", 0.5)),
        ({"NOTIFY_SOCKET": "/a", "WATCHDOG_USEC": "500000", "WATCHDOG_PID": "8"}, ("/a", None)),
        ({"NOTIFY_SOCKET": "/a", "WATCHDOG_USEC": "0"}, ("/a", None)),
        ({"NOTIFY_SOCKET": "/a", "WATCHDOG_USEC": "-1"}, ("/a", None)),
        ({"WATCHDOG_USEC": "500000"}, (None, None)),
        ({"NOTIFY_SOCKET": ""}, (None, None)),
    ],
)
def test_what_it_wants_stands_in_the_environment(
    environment: dict[str, str], wanted: tuple[str | None, float | None]
) -> None:
    """And does so no longer."""
    ours = {**environment, "LISTEN_FDS": "1", "HOME": "/root"}
    summons = taken(ours, 7)
    assert (summons.address, summons.period) == wanted
    assert ours == {"HOME": "/root"}
    assert {*environment} <= {*PERSONAL}


def test_processes_get_nothing_of_it_but_what_their_description_says() -> None:
    caller = {**dict.fromkeys(PERSONAL, "/of/ours"), "HOME": "/root"}
    host = Host("/usr", None, (), ament=False)
    description = {"NOTIFY_SOCKET": "/of/theirs"}
    got = node_environment(caller, host, description, log_folder="/log", colour=False, marks=("run", "a"))
    assert got["NOTIFY_SOCKET"] == "/of/theirs"
    assert {*got} & {*PERSONAL} == {"NOTIFY_SOCKET"}
    assert got["HOME"] == "/root"


@dataclass
class _Seen:
    """A process as the service manager's side sees it."""

    id: str
    state: State
    awaited: str = "a message on /clock"

    @property
    def name(self) -> str:
        return self.id


@pytest.mark.parametrize(
    ("state", "wanted"),
    [
        (State(Phase.WAITING), False),
        (State(Phase.STARTING), False),
        (State(Phase.RUNNING), False),
        (State(Phase.RUNNING, been_ready=True), True),
        (State(Phase.READY, been_ready=True), True),
        (State(Phase.RESTARTING), False),
        (State(Phase.RESTARTING, been_ready=True), True),
        (State(Phase.EXITED), True),
        (State(Phase.FAILED), True),
        (State(Phase.SKIPPED), True),
        (State(Phase.STOPPING), False),
    ],
)
def test_who_is_waited_for(state: State, wanted: bool) -> None:
    assert settled(_Seen("a", state), lambda _name: False) is wanted
    assert settled(_Seen("a", state), lambda name: name == "a")


def test_the_status_is_one_line_and_not_too_long() -> None:
    def nobody(_name: str) -> bool:
        return False

    assert status([], nobody) == "0 of 0 running"
    seen = [
        _Seen("up", State(Phase.READY, been_ready=True)),
        _Seen("comes", State(Phase.RUNNING)),
        _Seen("later", State(Phase.WAITING)),
        _Seen("failed", State(Phase.FAILED)),
        _Seen("again", State(Phase.RESTARTING, been_ready=True)),
    ]
    assert status(seen, nobody) == (
        "2 of 5 running; failed failed; starting again again; waiting for comes (a message on /clock), later"
    )
    many = [_Seen("x" * 30, State(Phase.RUNNING)) for _ in range(50)]
    assert "and 47 more" in status(many, nobody) or len(status(many, nobody)) == 200


def test_the_unit_in_the_documentation_is_one() -> None:
    """Every line that the page explains is in the unit, and the unit says what we rely on."""
    page = (Path(__file__).parents[2] / "docs" / "service-manager.md").read_text("utf-8")
    unit = ConfigParser(interpolation=None)
    unit.optionxform = str  # type: ignore[assignment,method-assign] # keys keep their capitals
    unit.read_string(page.partition("```ini\n")[2].partition("```")[0])
    service = unit["Service"]
    assert (service["Type"], service["NotifyAccess"], service["KillMode"]) == ("notify", "all", "mixed")
    explained = [
        line.split("`")[1] for line in page.splitlines() if line.startswith(("| `", "|`")) and "=" in line
    ]
    for key, _, value in (line.partition("=") for line in explained[:9]):
        assert service[key] == value
