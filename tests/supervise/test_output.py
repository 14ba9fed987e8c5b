"""What programs write: every byte of it, whoever wrote it, however fast, and whatever the disk does."""

from __future__ import annotations

import os
import random
import select
import signal
import socket
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.logs import records
from orchestra.supervise.options import RunOptions
from tests.supervise.plans import PATIENCE, after, finished, launched, plan, process, wait_for

if TYPE_CHECKING:
    from orchestra.plan.model import Process

LINGERS = process("lingers", "polite", "say=up", "linger")


def python(identity: str, code: str, **changes: object) -> Process:
    return process(identity, command=(sys.executable, "-S", "-E", "-c", code), **changes)


def test_noise_is_kept_byte_by_byte(tmp_path: Path) -> None:
    noise = random.Random(5).randbytes(300_000) + b"\x1b[3"  # noqa: S311 - the same noise each time
    (tmp_path / "noise").write_bytes(noise)
    code = f"import os; data = open({str(tmp_path / 'noise')!r}, 'rb').read()\nwhile data: data = data[os.write(1, data[:777]):]"
    run = finished(tmp_path, plan(python("pipe", code), python("terminal", code, emulate_tty=True)))
    assert run.popen.returncode == 0
    for name in ("pipe", "terminal"):
        assert (run.directory / "logs" / f"{name}.log").read_bytes() == noise
    told = [
        record for record in records.read(run.directory / "logs" / "all.jsonl") if record.process == "pipe"
    ]
    assert all(record.stream == "stdout" and record.pid for record in told)


@pytest.mark.parametrize("emulate_tty", [False, True])
def test_a_program_killed_while_it_writes_has_written_what_the_kernel_took(
    tmp_path: Path, emulate_tty: bool
) -> None:
    """The pipe holds 64 KiB that nobody has read yet; the last line has no end."""
    code = "import os; written = os.write(1, b'x' * 30000 + b'last'); os.kill(os.getpid(), 9)"
    run = finished(tmp_path, plan(python("a", code, emulate_tty=emulate_tty)))
    assert (run.directory / "logs" / "a.log").read_bytes() == b"x" * 30000 + b"last"


def test_what_a_grandchild_writes_after_the_end_of_the_program_is_kept(tmp_path: Path) -> None:
    """It ignores SIGTERM, so it has time to write more than a pipe holds."""
    code = """
import os, signal
for number in (signal.SIGINT, signal.SIGTERM):
    signal.signal(number, signal.SIG_IGN)
leader = os.getpid()
if os.fork():
    os.write(1, b"leader\\n")
    os._exit(0)
while os.getppid() == leader:
    pass
data = b"".join(b"%d\\n" % number for number in range(1, 50001)) + b"end"
while data:
    data = data[os.write(1, data):]
"""
    run = finished(tmp_path, plan(python("a", code)))
    lines = [str(number) for number in range(1, 50001)]
    assert run.log("a").split("\n") == ["leader", *lines, "end"]


def test_a_stream_that_a_stranger_still_holds_is_read_on(tmp_path: Path) -> None:
    """The program has given it to somebody who is no descendant of it: to us."""
    path = str(tmp_path / "s")
    code = f"""
import os, socket
connection = socket.socket(socket.AF_UNIX)
connection.connect({path!r})
socket.send_fds(connection, [b"x"], [1])
os.write(1, b"leader\\n")
"""
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind(path)
        listener.listen()
        with launched(tmp_path, plan(python("a", code), LINGERS)) as run:
            connection, _ = listener.accept()
            with connection:
                _, (held,), _, _ = socket.recv_fds(connection, 1, 1)
            run.await_event("process_exited", "a")
            with os.fdopen(held, "wb") as output:
                output.write(b"late" * 20000)
            wait_for(lambda: run.log("a") == "leader\n" + "late" * 20000, "what the stranger wrote")
            run.send(signal.SIGINT)
            assert run.wait() == 130


@pytest.mark.conforms("4.10 unit")
def test_streams_keep_their_own_order(tmp_path: Path) -> None:
    code = "import os\nfor n in range(20000): os.write(1 + n % 2, b'%d\\n' % n)"
    run = finished(tmp_path, plan(python("a", code)))
    found = [
        (r.stream, int(r.text))
        for r in records.read(run.directory / "logs" / "all.jsonl")
        if r.process == "a"
    ]
    for stream, begin in (("stdout", 0), ("stderr", 1)):
        assert [number for name, number in found if name == stream] == list(range(begin, 20000, 2))
    assert sorted(map(int, run.log("a").split())) == list(range(20000))


def test_the_noise_of_some_starves_nobody(tmp_path: Path) -> None:
    noisy = [
        process(f"noisy{number}", command=("/usr/bin/yes", f"noise {number}"), output="own_log")
        for number in range(4)
    ]
    options = RunOptions(log_size=1_000_000, log_keep=1)
    with launched(tmp_path, plan(*noisy, LINGERS), options) as run:
        run.await_line("lingers", "up")
        wait_for(
            lambda: len(list((run.directory / "logs").glob("noisy*.log.*"))) >= 4,
            "every noise to be put away",
        )
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert run.log("lingers") == "up\nbye\n"
        sizes = {path.name: path.stat().st_size for path in (run.directory / "logs").glob("*.log*")}
        assert max(sizes.values()) <= 1_000_000
        assert len(sizes) <= 2 * (len(noisy) + 1) + 1


def blocked(name: str) -> Process:
    """Put a pipe that nobody reads in the place of a log file: whoever opens it waits, as with a disk that has gone."""
    return process("block", command=("/bin/sh", "-c", f'mkfifo "${{ROS_LOG_DIR%/ros}}/{name}.log"'))


def resident(pid: int) -> int:
    """Return the memory of a process in bytes."""
    return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_a_disk_that_hangs_stops_nobody(tmp_path: Path) -> None:
    noisy = process(
        "noisy", "polite", "bytes=12000000", "complain=done", "linger",
        depends_on=after("block", "completed"), output={"stderr": ("screen",)},
    )  # fmt: skip
    with launched(tmp_path, plan(blocked("noisy"), noisy)) as run:
        supervisor = run.own("orc-supervisor")
        wait_for(lambda: "[noisy] done" in run.stdout, "the end of the noise")
        assert resident(supervisor) < 120_000_000
        run.send(signal.SIGINT)
        assert run.wait() == 130
        run.assert_gone(1.0)
    assert run.stderr.count("logs are incomplete: the disk has taken nothing for 2 s") == 1
    assert "bytes of logs could not be written" in run.stderr


def test_a_disk_that_is_only_slow_loses_nothing(tmp_path: Path) -> None:
    """Somebody reads the pipe, so it is a disk that takes its time; the program waits for it."""
    size = 6_000_000
    go = tmp_path / "go"
    there = process("there", command=("sh", "-c", f"until test -e {go}; do sleep 0.02; done"))
    begins = (*after("block", "completed"), *after("there", "completed"))
    noisy = process("noisy", f"bytes={size}", depends_on=begins, output="own_log")
    with launched(tmp_path, plan(blocked("noisy"), there, noisy), stdout=subprocess.DEVNULL) as run:
        run.await_event("process_exited", "block")
        received = 0
        descriptor = os.open(run.directory / "logs" / "noisy.log", os.O_RDONLY | os.O_NONBLOCK)
        go.touch()
        assert select.select([descriptor], [], [], PATIENCE)[0], "the first of it"
        os.set_blocking(descriptor, True)
        while data := os.read(descriptor, 1 << 16):
            received += len(data)
        os.close(descriptor)
        assert run.wait() == 0
    assert received == size
    assert "logs are incomplete" not in run.stderr


def test_a_folder_that_cannot_be_written_to_is_told_once(tmp_path: Path) -> None:
    """Folders stand where the files should be: root may write to any folder, but to none as a file."""
    script = 'mkdir "${ROS_LOG_DIR%/ros}/noisy.log"'
    spoil = process("spoil", command=("/bin/sh", "-c", script))
    noisy = process("noisy", "bytes=120000", depends_on=after("spoil", "completed"))
    run = finished(tmp_path, plan(spoil, noisy))
    assert run.popen.returncode == 0
    assert run.stderr.count("logs are incomplete") == 1
    assert "[orchestra] 120000 bytes of logs could not be written" in run.stderr
    assert run.log("all").count("[noisy]") == 10_000


def test_severity_is_read_in_the_form_of_the_process(tmp_path: Path) -> None:
    own = process(
        "own",
        "complain=E own.logger hello",
        environment={"RCUTILS_CONSOLE_OUTPUT_FORMAT": "E {name} {message}"},
    )
    usual = process("usual", "complain=[ERROR] [1700000000.5] [a.b]: broken", "complain=more")
    run = finished(tmp_path, plan(own, usual))
    found = {
        (r.process, r.severity, r.logger)
        for r in records.read(run.directory / "logs" / "all.jsonl")
        if r.process
    }
    assert {("own", None, "own.logger"), ("usual", "error", "a.b")} <= found
