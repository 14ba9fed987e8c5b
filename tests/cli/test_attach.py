"""Attaching to processes of a run, at a terminal of its own."""

from __future__ import annotations

import os
import pty
import re
import select
import signal
import subprocess
import sys
import termios
import time
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any, TypeAlias

import pytest

from orchestra.supervise.runs import registry
from orchestra.values import Restart
from tests.supervise.plans import launched, plan, process, wait_for

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path
    from subprocess import CompletedProcess

    from tests.supervise.plans import Launched

    Command: TypeAlias = Callable[..., CompletedProcess[str]]

PATIENCE = 30.0
# Reads lines and says what it has read; what its terminal does with a key it tells by the size and the modes.
_TALKER = r"""
import os, sys
print("size", *os.get_terminal_size(0), flush=True)
for line in sys.stdin:
    if line.strip() == "size":
        print("size", *os.get_terminal_size(0), flush=True)
    elif line.strip() == "leave":
        sys.exit(5)
    else:
        print("heard", line.strip(), flush=True)
"""
_TYPED_TO = """\
launch:
  - executable: {cmd: sh -c 'tty; read line; echo heard "$line"', name: talker, stdin: true, required: true}
"""


@pytest.fixture
def run(tmp_path: Path) -> Iterator[Launched]:
    talker = (sys.executable, "-c", _TALKER)
    processes = [
        process("/talker", command=talker, emulate_tty=True),
        process("/mute", "say=from the mute", "linger"),
        process("/again", command=talker, emulate_tty=True, restart=Restart("always", delay=0.05)),
    ]
    with launched(tmp_path, plan(*processes)) as started:
        for one in processes:
            started.await_event("process_running", one.id)
        yield started


class Attached:
    """`orchestra attach` at a terminal."""

    def __init__(self, home: Path, *words: str) -> None:
        self.shown = b""
        ours, theirs = pty.openpty()
        termios.tcsetwinsize(theirs, (33, 99))
        self.terminal = ours
        self.before = termios.tcgetattr(theirs)
        self.theirs = theirs
        self._open: tuple[int, ...] = (ours, theirs)
        self.popen = subprocess.Popen(
            [sys.executable, "-m", "orchestra", "attach", *words],
            env={**os.environ, "ORCHESTRA_HOME": str(home)},
            stdin=theirs,
            stdout=theirs,
            stderr=theirs,
        )

    def type(self, text: bytes) -> None:
        os.write(self.terminal, text)

    def read_until(self, words: bytes, count: int = 1) -> bytes:
        deadline = time.monotonic() + PATIENCE
        while self.shown.count(words) < count:
            assert time.monotonic() < deadline, self.shown
            if select.select([self.terminal], [], [], 0.1)[0]:
                self.shown += os.read(self.terminal, 65536)
        return self.shown

    def raw(self) -> bool:
        return not termios.tcgetattr(self.theirs)[3] & termios.ICANON

    def end(self) -> int:
        """Wait for the end; the terminal is what it was."""
        status = self.popen.wait(PATIENCE)
        assert termios.tcgetattr(self.theirs) == self.before
        while select.select([self.terminal], [], [], 0)[0]:
            self.shown += os.read(self.terminal, 65536)
        self.close()
        return status

    def close(self) -> None:
        """Give the terminal back; nothing is left of the command whatever has become of the test."""
        if self.popen.poll() is None:
            self.popen.kill()
            self.popen.wait()
        for descriptor in self._open:
            os.close(descriptor)
        self._open = ()


@pytest.fixture
def attach(home: Path) -> Iterator[Callable[..., Attached]]:
    """Begin to attach, with the words of the command."""
    with ExitStack() as opened:

        def begun(*words: str) -> Attached:
            attached = Attached(home, *words)
            opened.callback(attached.close)
            return attached

        yield begun


@pytest.mark.parametrize("leaving", [b"\x10\x11", b"\r~."])
def test_what_is_typed_is_read_and_the_keys_to_leave_are_not(
    run: Launched, attach: Callable[..., Attached], leaving: bytes
) -> None:
    attached = attach("talker")
    wait_for(attached.raw, "the modes of the terminal")
    attached.type(b"hello\r")
    attached.read_until(b"heard hello\r\n")
    attached.type(leaving)
    attached.read_until(b"left; the process goes on")
    assert attached.end() == 0
    assert run.of_kind("process_ended", "/talker") == []
    assert attached.shown.count(b"hello") == 2  # the echo of its terminal, and the answer


def test_the_terminal_of_the_process_has_the_size_of_ours(
    run: Launched, attach: Callable[..., Attached]
) -> None:
    del run
    attached = attach("talker")
    wait_for(attached.raw, "the modes of the terminal")
    attached.type(b"size\r")
    attached.read_until(b"size 99 33\r\n")
    termios.tcsetwinsize(attached.theirs, (20, 50))
    attached.popen.send_signal(signal.SIGWINCH)  # as the kernel does for a terminal in the foreground

    def resized() -> bool:
        attached.type(b"size\r")
        attached.read_until(b"size ", attached.shown.count(b"size ") + 1)
        return b"size 50 20" in attached.shown

    wait_for(resized, "the new size")
    attached.type(b"\x10\x11")
    assert attached.end() == 0


def test_keys_reach_the_process_that_has_a_terminal_for_itself(
    tmp_path: Path, attach: Callable[..., Attached]
) -> None:
    terminal, inner = pty.openpty()
    talker = process("/talker", command=(sys.executable, "-c", _TALKER), stdin=True)
    with launched(tmp_path, plan(talker), stdin=inner) as run:
        log = run.directory / "logs" / "talker.log"
        # An interpreter that is interrupted while it begins has another end.
        wait_for(lambda: log.exists() and "size" in log.read_text(), "its begin")
        attached = attach("talker")
        wait_for(attached.raw, "the modes of the terminal")
        attached.type(b"\x03")
        attached.read_until(b"the process has ended: ")
        assert attached.end() == 0
        assert run.await_event("process_ended", "/talker").data["signal"] == signal.SIGINT
        run.wait()
    os.close(terminal)
    os.close(inner)


def test_the_end_of_the_process_is_the_end(run: Launched, attach: Callable[..., Attached]) -> None:
    del run
    attached = attach("talker")
    wait_for(attached.raw, "the modes of the terminal")
    attached.type(b"leave\r")
    attached.read_until(b"the process has ended: exit code 5")
    assert attached.end() == 0


def test_a_process_that_starts_again_stays_attached(run: Launched, attach: Callable[..., Attached]) -> None:
    attached = attach("again")
    wait_for(attached.raw, "the modes of the terminal")
    attached.type(b"leave\r")
    run.await_event("process_running", "/again", 2)
    attached.read_until(b"size ")
    attached.type(b"hello\r")
    attached.read_until(b"heard hello")
    attached.type(b"\x10\x11")
    assert attached.end() == 0


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT])
def test_a_signal_gives_the_terminal_back_first(
    run: Launched, attach: Callable[..., Attached], number: signal.Signals
) -> None:
    del run
    attached = attach("talker")
    wait_for(attached.raw, "the modes of the terminal")
    attached.popen.send_signal(number)
    assert attached.end() == 128 + number


def test_the_end_of_the_run_gives_the_terminal_back(run: Launched, attach: Callable[..., Attached]) -> None:
    attached = attach("talker")
    wait_for(attached.raw, "the modes of the terminal")
    run.send(signal.SIGINT)
    run.wait()
    assert attached.end() == 0
    assert re.search(rb"the (process|run) has ended", attached.shown)


def test_a_killed_supervisor_gives_the_terminal_back(run: Launched, attach: Callable[..., Attached]) -> None:
    attached = attach("talker")
    wait_for(attached.raw, "the modes of the terminal")
    os.kill(run.own("orc-supervisor"), signal.SIGKILL)
    assert attached.end() == 0
    assert b"the run has ended" in attached.shown
    run.wait()


def test_a_process_without_a_terminal_is_only_looked_at(
    tmp_path: Path, attach: Callable[..., Attached]
) -> None:
    counting = ("sh", "-c", "while :; do echo tick; sleep 0.1; done")
    with launched(tmp_path, plan(process("/clock", command=counting))) as run:
        run.await_line("clock", "tick")
        attached = attach("clock")
        attached.read_until(b"tick")
        assert not attached.raw()
        attached.popen.send_signal(signal.SIGINT)
        assert attached.end() == 0
        assert run.of_kind("process_ended", "/clock") == []


def test_looking_without_typing(run: Launched, attach: Callable[..., Attached]) -> None:
    attached = attach("--no-input", "talker")
    other = attach("talker")
    wait_for(other.raw, "the modes of the terminal")
    attached.type(b"not this\r")

    def seen() -> bool:
        """Until the first has begun to look, it sees nothing of what the second causes."""
        other.type(b"but this\r")
        other.read_until(b"heard but this", other.shown.count(b"heard but this") + 1)
        if select.select([attached.terminal], [], [], 0.1)[0]:
            attached.shown += os.read(attached.terminal, 65536)
        return b"heard but this" in attached.shown

    wait_for(seen, "the output")
    attached.popen.send_signal(signal.SIGINT)
    assert attached.end() == 0
    other.type(b"\x10\x11")
    assert other.end() == 0
    assert b"heard not this" not in attached.shown + other.shown
    del run


def test_more_than_a_terminal_holds_is_typed_in_pieces(tmp_path: Path, home: Path) -> None:
    """From a file: nothing is lost although the terminal takes some 4 kB of lines at a time."""
    silent = "import termios; modes = termios.tcgetattr(0); modes[3] &= ~termios.ECHO; termios.tcsetattr(0, 0, modes)"
    talker = (sys.executable, "-c", f"{silent}; print('quiet', flush=True)\n{_TALKER}")
    words = b"".join(b"line %d\n" % number for number in range(3000)) + b"leave\n"
    with launched(tmp_path, plan(process("/talker", command=talker, emulate_tty=True))) as run:
        run.await_line("talker", "quiet")
        done = subprocess.run(
            [sys.executable, "-m", "orchestra", "attach", "talker"],
            env={**os.environ, "ORCHESTRA_HOME": str(home)},
            input=words,
            capture_output=True,
            timeout=PATIENCE,
            check=True,
        )
        assert run.await_event("process_ended", "/talker").data["code"] == 5
    heard = re.findall(rb"heard line (\d+)\n", done.stdout)
    assert [int(number) for number in heard] == list(range(3000))


def test_whom_nobody_can_attach_to(run: Launched, orchestra: Command) -> None:
    found: Any = orchestra("attach", "*")
    assert (found.returncode, found.stdout) == (2, "")
    assert "'*' is 3 processes, and one can be attached to" in found.stderr
    assert orchestra("stop", "mute").returncode == 0
    found = orchestra("attach", "mute")
    assert (found.returncode, found.stderr) == (1, "error: run: mute does not run\n")
    del run


def test_a_detached_run_has_its_one_terminal_for_whoever_attaches(
    orchestra: Command, home: Path, folder: Path, attach: Callable[..., Attached]
) -> None:
    (folder / "talk.launch.yaml").write_text(_TYPED_TO)
    assert orchestra("launch", "--detach", "talk.launch.yaml").returncode == 0
    (run,) = registry.living(home / "runs")
    log = run.directory / "logs" / "talker.log"
    wait_for(lambda: log.exists() and "/dev/pts/" in log.read_text(), "the terminal")
    attached = attach("talker")
    wait_for(attached.raw, "the modes of the terminal")
    attached.type(b"hello\r")
    attached.read_until(b"heard hello")
    assert attached.end() == 0
    wait_for(lambda: not registry.living(home / "runs"), "the end of the run")
