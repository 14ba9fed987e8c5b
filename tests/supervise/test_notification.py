"""What processes notify us of, and what strangers try to."""

from __future__ import annotations

import array
import os
import socket
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.plan.conditions import Alive
from orchestra.supervise.keeping import proc
from orchestra.supervise.signs.notification import parse, seconds
from tests.supervise.plans import PROCESSES, after, finished, launched, plan, process
from tests.supervise.test_readiness import client, ready, text

if TYPE_CHECKING:
    from orchestra.plan.model import Process
    from tests.supervise.plans import Launched


def notifier(name: str, *words: str, **changes: Any) -> Process:
    """Return a process that notifies as its words say."""
    command = (sys.executable, "-S", "-E", str(PROCESSES / "notifier.py"), *words)
    return process(name, command=command, **changes)


def address_of(run: Launched, name: str) -> str:
    """Return the name of the socket of a process that runs."""
    pid = run.await_event("process_running", name).pid
    assert pid is not None
    (found,) = proc.marks(pid, ("NOTIFY_SOCKET",))
    assert found is not None
    return f"\0{found[1:]}"


@pytest.mark.parametrize(
    "words", [("tell=READY=1",), ("tell=STATUS=all is well|READY=1|X=",), ("child=READY=1",)]
)
def test_a_process_says_itself_that_it_is_ready(tmp_path: Path, words: tuple[str, ...]) -> None:
    run = finished(tmp_path, plan(notifier("server", *words, "linger", ready=ready(notify=True)), client()))
    assert run.popen.returncode == 0
    assert "waiting for server: READY=1 from it" in run.stderr


def test_one_that_ends_as_soon_as_it_has_said_so_was_ready(tmp_path: Path) -> None:
    server = notifier("server", "tell=READY=1", "exit=0", ready=ready(notify=True))
    run = finished(tmp_path, plan(server, client()))
    assert run.popen.returncode == 0
    assert run.of_kind("process_ready", "server")


def test_a_timeout_tells_what_the_process_says_of_itself(tmp_path: Path) -> None:
    words = ("tell=READY=0|STATUS=loading a \x1b[31mmap", "barrier", "say=told", "linger")
    run = finished(tmp_path, plan(notifier("server", *words, ready=ready(notify=True, timeout=2.0))))
    assert run.popen.returncode == 1
    assert "not ready within 2 s: waited for READY=1 from it (loading a [31mmap)" in text(run)


def test_a_process_may_ask_for_more_time(tmp_path: Path) -> None:
    """It is ready only when we say so, which is long after its timeout."""
    go = tmp_path / "go"
    words = ("tell=EXTEND_TIMEOUT_USEC=60000000", f"await={go}", "tell=READY=1", "linger")
    server = notifier("server", *words, ready=ready(notify=True, timeout=2.5))
    with launched(tmp_path, plan(server, process("waits", command=("sleep", "2.8")), client())) as run:
        run.await_event("process_exited", "waits")
        go.touch()
        assert run.wait() == 0


def test_messages_of_strangers_count_not_and_do_no_harm(tmp_path: Path) -> None:
    """Garbage, empty and huge ones, with descriptors, in crowds, and READY=1 from another process of the run."""
    go = tmp_path / "go"
    server = notifier("server", f"await={go}", "tell=READY=1", "linger", ready=ready(notify=True))
    with launched(tmp_path, plan(server, client())) as run:
        address = address_of(run, "server")
        pid = run.own("orc-supervisor")
        descriptors = Path(f"/proc/{pid}/fd")
        before = len([*descriptors.iterdir()])
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as stranger:
            for message in (
                b"READY=1",
                b"",
                b"\0\xff" * 50,
                b"READY=1\n" * 20000,
                b"=\n==\nREADY",
                b"WATCHDOG=trigger",
            ):
                stranger.sendto(message, address)
            with open(os.devnull, "rb") as held:  # noqa: PTH123 - only its descriptor counts
                rights = array.array("i", [held.fileno()] * 200)
                stranger.sendmsg(
                    [b"READY=1\nFDSTORE=1"], [(socket.SOL_SOCKET, socket.SCM_RIGHTS, rights)], 0, address
                )
            for _ in range(300):
                stranger.sendto(b"READY=1", address)
            readable, writable = os.pipe()
            stranger.sendmsg(
                [b"BARRIER=1"],
                [(socket.SOL_SOCKET, socket.SCM_RIGHTS, array.array("i", [writable]))],
                0,
                address,
            )
            os.close(writable)
            assert os.read(readable, 1) == b""  # everything has been read
            os.close(readable)
        assert len([*descriptors.iterdir()]) < before + 5  # a log may have been opened
        assert not run.of_kind("process_ready")
        go.touch()
        assert run.wait() == 0
    log = (run.directory / "logs" / "all.log").read_text("utf-8")
    assert f"a notification for server came from process {os.getpid()}, which is none of its own" in log
    assert log.count("a notification for server") == 1


def test_one_process_does_not_speak_for_another(tmp_path: Path) -> None:
    """A second process of the run has the name of the first one's socket, and says READY=1 there."""
    first = notifier("first", f"await={tmp_path / 'go'}", "linger", ready=ready(notify=True, timeout=30.0))
    script = 'while ! test -e "$1"; do sleep 0.02; done; NOTIFY_SOCKET=$(cat "$1") exec "$2" -S -E "$3" tell=READY=1 barrier'
    second = process(
        "second",
        command=(
            "sh",
            "-c",
            script,
            "sh",
            str(tmp_path / "name"),
            sys.executable,
            str(PROCESSES / "notifier.py"),
        ),
    )
    with launched(tmp_path, plan(first, second)) as run:
        name = address_of(run, "first")
        (tmp_path / "written").write_text(f"@{name[1:]}")
        (tmp_path / "written").rename(tmp_path / "name")
        run.await_event("process_exited", "second")
        assert not run.of_kind("process_ready")


def test_descriptors_are_closed_and_barriers_hold(tmp_path: Path) -> None:
    server = notifier(
        "server",
        "crowd=200,STATUS=x",
        "barrier",
        "say=passed",
        "tell=READY=1",
        "linger",
        ready=ready(notify=True),
    )
    run = finished(tmp_path, plan(server, client()))
    assert run.popen.returncode == 0
    assert run.log("server") == "passed\n"


def test_a_crowd_of_messages_slows_its_sender_and_nobody_else(tmp_path: Path) -> None:
    """The queue of a socket is short (unix(7)): who sends without end has to wait, and others are served."""
    crowd = notifier("crowd", "crowd=1000000000,STATUS=again", ready=ready(notify=True))
    others = [process(f"other{n}", "say=up", "linger", ready=ready(log="up")) for n in range(3)]
    last = process(
        "last",
        "exit=0",
        required=True,
        depends_on=tuple(d for n in range(3) for d in after(f"other{n}", "ready")),
    )
    run = finished(tmp_path, plan(crowd, *others, last))
    assert run.popen.returncode == 0


def test_only_who_needs_them_has_the_variables(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither what a service manager said to us, nor the socket of another process."""
    theirs = ("NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID", "LISTEN_FDS", "LISTEN_PID", "LISTEN_FDNAMES")
    for name in theirs:
        monkeypatch.setenv(name, "/of/the/service/manager" if name == "NOTIFY_SOCKET" else "1")
    shows = [f"show={name}" for name in theirs]
    guarded = notifier("guarded", *shows, "exit=0", alive=Alive(notify=1.5))
    plain = process("plain", *shows, "exit=0", depends_on=after("guarded", "exited"))
    run = finished(tmp_path, plan(guarded, plain))
    assert run.log("plain") == "".join(f"{name}=None\n" for name in theirs)
    socket_line, *others = run.log("guarded").splitlines()
    assert socket_line.startswith("NOTIFY_SOCKET=@orchestra/")
    assert others == [f"{name}={'1500000' if name == 'WATCHDOG_USEC' else None}" for name in theirs[1:]]


def test_a_socket_is_gone_with_its_run(tmp_path: Path) -> None:
    """Every start has one of its own, and none of them is left in the kernel."""
    server = notifier("server", "tell=READY=1", "show=NOTIFY_SOCKET", "linger", ready=ready(notify=True))
    run = finished(tmp_path, plan(server, client()))
    name = run.log("server").strip().removeprefix("NOTIFY_SOCKET=@")
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as late, pytest.raises(ConnectionRefusedError):
        late.sendto(b"READY=1", f"\0{name}")


@pytest.mark.parametrize(
    ("message", "wanted"),
    [
        (b"READY=1", {"READY": "1"}),
        (b"READY=1\nSTATUS=a=b c\n\nMAINPID=1\n", {"READY": "1", "STATUS": "a=b c", "MAINPID": "1"}),
        (b"STATUS=\x1b]0;evil\x07\ttab\x00", {"STATUS": "]0;eviltab"}),
        (b"\xff\xfe=\xff", {"��": "�"}),
        (b"=1\nREADY\n", {}),
        (b"STATUS=" + b"x" * 4000, {"STATUS": "x" * 512}),
        (b"", {}),
    ],
)
def test_messages_are_lines_of_assignments(message: bytes, wanted: dict[str, str]) -> None:
    assert parse(message) == wanted


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("1500000", 1.5),
        ("0", None),
        ("", None),
        (None, None),
        ("-1", None),
        ("1.5", None),
        ("\u0661", None),
        ("soon", None),
        ("9" * 512, 2**63 / 1e6),
    ],
)
def test_times_are_in_microseconds(text: str | None, wanted: float | None) -> None:
    assert seconds(text) == wanted


def test_the_longest_of_times_can_be_waited_for(tmp_path: Path) -> None:
    """It is longer than the kernel can be asked to wait at once."""
    words = ("tell=EXTEND_TIMEOUT_USEC=18446744073709551615", "barrier", "tell=READY=1", "linger")
    server = notifier("server", *words, ready=ready(notify=True, timeout=30.0))
    run = finished(tmp_path, plan(server, client()))
    assert run.popen.returncode == 0
