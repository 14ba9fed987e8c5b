"""Runs in a terminal: who hears it, and what happens when it is closed, blocked or slow."""

from __future__ import annotations

import contextlib
import os
import pty
import re
import select
import signal
import subprocess
import threading
import time
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.keeping import proc
from tests.supervise.plans import finished, launched, plan, process, wait_for

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from tests.supervise.plans import Launched

POLITE = process("polite", "polite", "say=up", "linger")


class Terminal:
    """The side of a terminal on which the user sits; it reads only when asked to."""

    def __init__(self) -> None:
        self.ours, self.theirs = pty.openpty()
        self.text = bytearray()
        os.set_blocking(self.ours, False)

    def read(self) -> bytearray:
        with contextlib.suppress(BlockingIOError, OSError):
            while data := os.read(self.ours, 65536):
                self.text += data
        return self.text

    def read_on(self) -> bytearray:
        """Read for as long as something comes."""
        while select.select([self.ours], [], [], 0.3)[0]:
            before = len(self.text)
            if len(self.read()) == before:
                break
        return self.text

    def type(self, text: bytes) -> None:
        os.write(self.ours, text)


@contextlib.contextmanager
def in_terminal(folder: Path, *processes: object, **kwargs: object) -> Iterator[tuple[Launched, Terminal]]:
    """Run with a terminal of its own as controlling terminal, as in a shell."""
    terminal = Terminal()
    theirs = terminal.theirs

    def take_terminal() -> None:
        os.setsid()
        signal.pthread_sigmask(signal.SIG_SETMASK, ())
        os.close(os.open(os.ttyname(theirs), os.O_RDWR))

    with launched(
        folder,
        plan(*processes),  # type: ignore[arg-type]
        stdin=theirs,
        stdout=theirs,
        stderr=theirs,
        preexec_fn=take_terminal,
        **kwargs,  # type: ignore[arg-type]
    ) as run:
        os.close(theirs)
        try:
            yield run, terminal
        finally:
            with contextlib.suppress(OSError):
                os.close(terminal.ours)


@pytest.mark.conforms("4.9 2", "4.9 3", "D32")
def test_ctrl_c_is_heard_once(tmp_path: Path) -> None:
    with in_terminal(tmp_path, POLITE) as (run, terminal):
        run.await_line("polite", "up")
        terminal.type(b"\x03")
        assert run.wait() == 130
        terminal.read()
        assert terminal.text.count(b"SIGINT: stopping") == 1
        assert b"again" not in terminal.text
        assert run.log("polite") == "up\nbye\n"


def test_only_the_keeper_is_in_the_terminals_session(tmp_path: Path) -> None:
    with in_terminal(tmp_path, POLITE) as (run, terminal):
        run.await_line("polite", "up")
        sessions = {pid: facts.session for pid in run.everything() if (facts := proc.stat(pid))}
        keeper = run.popen.pid
        assert [pid for pid, session in sessions.items() if session == sessions[keeper]] == [keeper]
        assert len(set(sessions.values())) == len(sessions)
        terminal.type(b"\x03")
        assert run.wait() == 130


def test_a_closed_terminal_is_a_graceful_stop(tmp_path: Path) -> None:
    with in_terminal(tmp_path, POLITE) as (run, terminal):
        run.await_line("polite", "up")
        os.close(terminal.ours)
        assert run.wait() == 129
        run.assert_gone(1.0)
        assert run.log("polite") == "up\nbye\n"
        assert run.events[-1].data == {"status": 129, "reason": "stopped by SIGHUP"}


def test_a_blocked_terminal_blocks_nobody(tmp_path: Path) -> None:
    """Nobody reads it, as after Ctrl-S, while a process writes far more than it takes."""
    noisy = process("noisy", "bytes=12000000", "say=done", "linger")
    with in_terminal(tmp_path, noisy) as (run, terminal):
        run.await_line("noisy", "done")
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert (run.directory / "logs" / "noisy.log").stat().st_size == 12_000_000 + len("done\n")
        assert not terminal.text


def accounted_for(text: bytearray) -> int:
    """Return how many lines of the process are shown or confessed to be missing, in as many confessions as it took."""
    missed = re.findall(rb"\[orchestra\] (\d+) lines are not shown: the screen was too slow", text)
    return text.count(b"[noisy]") + sum(map(int, missed))


def test_what_a_slow_terminal_missed_is_counted(tmp_path: Path) -> None:
    noisy = process("noisy", "bytes=3600000", "say=done", "linger")
    with in_terminal(tmp_path, noisy) as (run, terminal):
        run.await_line("noisy", "done")
        wait_for(
            lambda: accounted_for(terminal.read_on()) == 300_000 + len(["done"]),
            "every line, shown or counted",
        )
        assert terminal.text.count(b"[noisy]") < 300_000
        run.send(signal.SIGINT)
        assert run.wait() == 130


def test_colours_and_prefixes_on_a_terminal(tmp_path: Path) -> None:
    short, long = (
        process("/a", "say=one", "linger"),
        process("/robot1/ekf", "say=two", "show=RCUTILS_COLORIZED_OUTPUT", "linger"),
    )
    environment = {"TERM": "xterm", "NO_COLOR": "", "FORCE_COLOR": ""}
    with in_terminal(tmp_path, short, long, environment=environment) as (run, terminal):
        wanted = (
            b"\x1b[36m[a]\x1b[0m          one\r\n",
            b"\x1b[33m[robot1/ekf]\x1b[0m two\r\n",
            b"COLORIZED_OUTPUT=1\r\n",
        )
        wait_for(lambda: all(piece in terminal.read() for piece in wanted), "coloured lines")
        run.send(signal.SIGINT)
        assert run.wait() == 130


def test_no_colour_where_it_is_not_wanted(tmp_path: Path) -> None:
    with in_terminal(tmp_path, process("a", "say=one", "linger"), environment={"NO_COLOR": "1"}) as (
        run,
        terminal,
    ):
        wait_for(lambda: b"[a] one\r\n" in terminal.read(), "a plain line")
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert b"\x1b" not in terminal.read()


@pytest.mark.conforms("4.10 unit", "D34")
def test_an_unfinished_line_is_shown_soon_and_continued(tmp_path: Path) -> None:
    asking = process(
        "asking",
        command=("/bin/sh", "-c", "printf 'ready? '; read answer < pipe; echo $answer"),
        cwd=str(tmp_path),
    )
    os.mkfifo(tmp_path / "pipe")
    with launched(tmp_path, plan(asking)) as run:
        wait_for(lambda: run.stdout == "[asking] ready? ", "the question")
        (tmp_path / "pipe").write_text("yes\n")
        assert run.wait() == 0
        assert run.stdout == "[asking] ready? yes\n"


def test_everything_reaches_a_reader_to_the_last_byte(tmp_path: Path) -> None:
    size = 3_000_000
    run = finished(tmp_path, plan(process("a", f"bytes={size}", "partial=the end")))
    lines = [f"{number:011d}\n" for number in range(size // 12)]
    assert run.log("a") == "".join(lines) + "the end"
    assert run.stdout == "".join(f"[a] {line}" for line in [*lines, "the end\n"])
    merged = run.log("all").splitlines()
    assert sum("[a] " in line for line in merged) == len(lines) + 1


def test_a_pipe_that_is_read_slowly_gets_the_rest_at_the_end(tmp_path: Path) -> None:
    readable, writable = os.pipe()
    received = bytearray()

    def read() -> None:
        while data := os.read(readable, 4096):
            received.extend(data)
            time.sleep(0.0005)

    reader = threading.Thread(target=read)
    reader.start()
    with launched(tmp_path, plan(process("a", "bytes=1200000", "say=last")), stdout=writable) as run:
        os.close(writable)
        assert run.wait() == 0
    reader.join()
    os.close(readable)
    assert received.count(b"\n") == 100_001
    assert received.endswith(b"[a] last\n")


def test_a_reader_that_goes_away_ends_nothing(tmp_path: Path) -> None:
    readable, writable = os.pipe()
    noisy = process("noisy", "polite", "bytes=1200000", "say=done", "linger")
    with launched(tmp_path, plan(noisy), stdout=writable) as run:
        os.close(writable)
        os.read(readable, 10)
        os.close(readable)
        run.await_line("noisy", "done")
        run.send(signal.SIGINT)
        assert run.wait() == 130


def test_closed_standard_streams(tmp_path: Path) -> None:
    run = finished(
        tmp_path,
        plan(process("a", "say=one", "complain=two")),
        through=("/bin/sh", "-c", 'exec "$@" <&- >&- 2>&-', "sh"),
    )
    assert run.popen.returncode == 0
    assert sorted(run.log("a").splitlines()) == ["one", "two"]


@pytest.mark.conforms("4.10 log", "4.10 screen", "4.10 both")
def test_words_decide_what_the_screen_shows(tmp_path: Path) -> None:
    words = (None, "screen", "both", "full", "log", "own_log")
    talkers = [process(str(word), "say=out", "complain=err", output=word) for word in words]
    run = finished(tmp_path, plan(*talkers))
    shown = sorted(tuple(line.split()) for line in run.stdout.splitlines())
    loud = [(f"[{word}]", text) for word in (None, "screen", "both", "full") for text in ("out", "err")]
    assert shown == sorted([*loud, ("[log]", "err")])
    assert all(sorted(run.log(str(word)).split()) == ["err", "out"] for word in words)


@pytest.mark.conforms("1.3.2 emulate_tty")
def test_a_process_may_have_a_terminal(tmp_path: Path) -> None:
    run = finished(tmp_path, plan(process("a", "terminal", "bytes=120000", "partial=x", emulate_tty=True)))
    begin, _, rest = run.log("a").partition("\n")
    assert begin == "True True True"
    assert rest == "".join(f"{number:011d}\n" for number in range(10_000)) + "x"


def test_a_full_disk_is_told_once_and_ends_nothing(tmp_path: Path) -> None:
    """A limit on the size of files stands for it: writing fails just so."""
    script = ("/bin/sh", "-c", 'ulimit -f 64; exec "$@"', "sh")
    run = finished(tmp_path, plan(process("a", "bytes=240000")), through=script, stdout=subprocess.DEVNULL)
    assert run.popen.returncode == 0
    assert run.stderr.count("logs are incomplete") == 1
    assert "bytes of logs could not be written" in run.stderr
    assert (run.directory / "logs" / "a.log").stat().st_size <= 64 * 1024
