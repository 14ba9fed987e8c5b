"""One process has the user's terminal for itself: what is typed reaches it, and the terminal is given back."""

from __future__ import annotations

import fcntl
import os
import signal
import struct
import sys
import termios
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.loop import Loop
from orchestra.supervise.output.stream import Stream
from orchestra.supervise.output.terminal import MOST_TYPED, Terminal
from orchestra.supervise.process.spawn import spawn
from orchestra.supervise.process.spec import Spec
from tests.supervise.plans import finished, launched, plan, process, wait_for
from tests.supervise.test_terminal import in_terminal

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Process
    from tests.supervise.test_terminal import Terminal as UserTerminal

ECHO = termios.ECHO | termios.ICANON
LINGERS = process("lingers", "polite", "say=up", "linger")


def asking(code: str, **changes: object) -> Process:
    begin = "import getpass, os, signal, sys, termios\nprint('begun', flush=True)\n"
    return process("asking", command=(sys.executable, "-E", "-u", "-c", begin + code), stdin=True, **changes)


def modes(terminal: UserTerminal) -> int:
    """Return what decides about echo and lines; the master shows the modes of its terminal (pty(7))."""
    local: int = termios.tcgetattr(terminal.ours)[3] & ECHO
    return local


def await_text(terminal: UserTerminal, text: bytes) -> None:
    wait_for(lambda: text in terminal.read(), f"{text!r} in the terminal")


def begun(terminal: UserTerminal) -> None:
    await_text(terminal, b"begun")
    wait_for(lambda: modes(terminal) == 0, "keys to be passed on")


@pytest.mark.conforms("4.10 unit")
def test_lines_are_typed_and_ended(tmp_path: Path) -> None:
    code = "for line in sys.stdin: print('got', line.strip())\nprint('over')"
    with in_terminal(tmp_path, asking(code, required=True)) as (run, terminal):
        begun(terminal)
        terminal.type(b"one\rtwo\x7fx\r")
        await_text(terminal, b"got twx")
        terminal.type(b"\x04")
        assert run.wait() == 0
        assert modes(terminal) == ECHO
        text = terminal.read()
        assert text.count(b"one") == 2  # seen once as it was typed, and answered
        assert b"\x08 \x08x\r\n" in text
        assert run.log("asking").endswith("got twx\nover\n")


def test_it_has_a_terminal_that_controls_it(tmp_path: Path) -> None:
    """A password is asked for on /dev/tty, without echo; job control works where one has the foreground."""
    code = (
        "print(*map(os.isatty, range(3)), os.getsid(0) == os.getpid() == os.tcgetpgrp(0))\n"
        "print(len(getpass.getpass('password: ')))"
    )
    with in_terminal(tmp_path, asking(code, required=True)) as (run, terminal):
        await_text(terminal, b"password: ")
        wait_for(lambda: modes(terminal) == 0, "keys to be passed on")
        terminal.type(b"secret\r")
        assert run.wait() == 0
        assert b"True True True True\r\n" in terminal.read()
        assert b"secret" not in terminal.text
        assert run.log("asking").endswith("password: \n6\n")


def test_a_shell_has_job_control(tmp_path: Path) -> None:
    shell = process(
        "shell",
        command=("/bin/bash", "--norc", "-i"),
        stdin=True,
        required=True,
        environment={"PS1": "ready> "},
    )
    with in_terminal(tmp_path, shell) as (run, terminal):
        await_text(terminal, b"ready> ")
        wait_for(lambda: modes(terminal) == 0, "keys to be passed on")
        terminal.type(b"sleep 100 &\r")
        terminal.type(b"jobs; kill %1; echo $((6*7))\r")
        await_text(terminal, b"\r\n42\r\n")
        assert b"no job control" not in terminal.read()
        assert b"Running" in terminal.text
        terminal.type(b"exit 5\r")
        assert run.wait() == 5


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_the_terminal_is_given_back_whatever_ends_the_run(tmp_path: Path, number: signal.Signals) -> None:
    with in_terminal(tmp_path, asking("sys.stdin.read()"), LINGERS) as (run, terminal):
        run.await_line("lingers", "up")
        begun(terminal)
        if number == signal.SIGINT:
            terminal.type(b"\x03")
        else:
            run.send(number)
        assert run.wait() == 128 + number
        assert modes(terminal) == ECHO
        assert run.log("lingers") == "up\nbye\n"


def test_the_keeper_gives_the_terminal_back_where_the_supervisor_is_killed(tmp_path: Path) -> None:
    with in_terminal(tmp_path, asking("sys.stdin.read()")) as (run, terminal):
        begun(terminal)
        os.kill(run.own("orc-supervisor"), signal.SIGKILL)
        assert run.wait() == 1
        assert modes(terminal) == ECHO


def test_the_terminal_is_given_back_between_two_runs_of_the_process(tmp_path: Path) -> None:
    with in_terminal(tmp_path, asking("sys.stdin.readline()"), LINGERS) as (run, terminal):
        begun(terminal)
        terminal.type(b"\r")
        run.await_event("process_exited", "asking")
        wait_for(lambda: modes(terminal) == ECHO, "the terminal to be given back")
        terminal.type(b"\x03")
        assert run.wait() == 130


SHELL = """
set -m
"$@"
[[ $(stty -a) == *" icanon"* ]] && echo shell has lines
bg
echo shell is here
read line
echo shell got $line
fg
"""


def test_in_the_background_what_is_typed_is_the_shells(tmp_path: Path) -> None:
    """Suspended by Ctrl-Z, put into the background, and brought back, which nothing tells us."""
    through = ("/bin/bash", "--norc", "-c", SHELL, "bash")
    code = "for line in sys.stdin: print('got', line.strip())"
    with in_terminal(tmp_path, asking(code), through=through) as (run, terminal):
        begun(terminal)
        terminal.type(b"one\r")
        await_text(terminal, b"got one")
        terminal.type(b"\x1a")
        await_text(terminal, b"shell has lines")
        await_text(terminal, b"shell is here")
        terminal.type(b"two\r")
        await_text(terminal, b"shell got two")
        terminal.type(b"three\r")
        await_text(terminal, b"got three")
        wait_for(lambda: modes(terminal) == 0, "keys to be passed on")
        terminal.type(b"\x04")
        assert run.wait() == 0
        assert b"got two" not in terminal.read().replace(b"shell got two", b"")
        assert modes(terminal) == ECHO


BACK_AT_ONCE = """
set -m
"$@"
echo shell is here
bg
fg
"""


def test_keys_are_passed_on_again_where_nobody_heard_of_the_suspension(tmp_path: Path) -> None:
    """A supervisor that had no time for SIGTSTP never gets it, once SIGCONT has come."""
    through = ("/bin/bash", "--norc", "-c", BACK_AT_ONCE, "bash")
    code = "for line in sys.stdin: print('got', line.strip())"
    with in_terminal(tmp_path, asking(code), through=through) as (run, terminal):
        begun(terminal)
        os.kill(run.own("orc-supervisor"), signal.SIGSTOP)
        terminal.type(b"\x1a")
        await_text(terminal, b"shell is here")
        terminal.type(b"one\r")
        await_text(terminal, b"got one")
        wait_for(lambda: modes(terminal) == 0, "keys to be passed on")
        terminal.type(b"\x04")
        assert run.wait() == 0
        assert modes(terminal) == ECHO


def set_size(descriptor: int, columns: int, lines: int) -> None:
    fcntl.ioctl(descriptor, termios.TIOCSWINSZ, struct.pack("HHHH", lines, columns, 0, 0))


def test_another_size_of_our_terminal_is_that_of_the_programs(tmp_path: Path) -> None:
    code = (
        "signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGWINCH})\n"
        "print(*os.get_terminal_size())\nprint('ready')\n"
        # With a handler, one that comes right before the call that pauses would wait for the next.
        "while signal.sigwait({signal.SIGWINCH}): print('now', *os.get_terminal_size())"
    )
    own = process(
        "own", command=(sys.executable, "-E", "-u", "-c", f"import os, signal\n{code}"), emulate_tty=True
    )
    with in_terminal(tmp_path, asking(code), own) as (run, terminal):
        run.await_line("asking", "ready")
        run.await_line("own", "ready")
        set_size(terminal.ours, 123, 45)
        run.await_line("asking", "now 123 45")
        run.await_line("own", "now 123 45")
        terminal.type(b"\x03")
        assert run.wait() == 130


def test_a_terminal_that_is_closed_is_the_end_of_the_input_where_the_run_goes_on(tmp_path: Path) -> None:
    """As with nohup: a hang-up that is ignored ends nothing."""
    through = ("/bin/sh", "-c", "trap '' HUP; exec \"$@\"", "sh")
    with in_terminal(tmp_path, asking("print(repr(sys.stdin.read()))"), LINGERS, through=through) as (
        run,
        terminal,
    ):
        begun(terminal)
        terminal.type(b"half")
        run.await_line("lingers", "up")
        await_text(terminal, b"half")
        os.close(terminal.ours)
        run.await_event("process_exited", "asking")
        wait_for(lambda: "'half'" in run.log("asking"), "what it has read")
        assert run.popen.poll() is None
        run.send(signal.SIGTERM)
        assert run.wait() == 143


@pytest.mark.parametrize("emulate_tty", [False, True])
def test_a_pipe_is_read_to_its_end(tmp_path: Path, emulate_tty: bool) -> None:
    reading = process("asking", command=("/usr/bin/wc", "-c"), stdin=True, emulate_tty=emulate_tty)
    readable, writable = os.pipe()
    with launched(tmp_path, plan(reading), stdin=readable) as run:
        os.close(readable)
        with os.fdopen(writable, "wb") as file:
            file.write(b"x" * 1_000_000)
        assert run.wait() == 0
        assert run.log("asking") == "1000000\n"


def test_a_file_is_read_to_its_end(tmp_path: Path) -> None:
    (tmp_path / "input").write_text("hello\n")
    with (tmp_path / "input").open() as file:
        run = finished(tmp_path, plan(process("asking", command=("/bin/cat",), stdin=True)), stdin=file)
    assert run.log("asking") == "hello\n"


def test_nobody_else_reads_what_is_typed(tmp_path: Path) -> None:
    with in_terminal(tmp_path, process("quiet", command=("/bin/cat",), required=True)) as (run, terminal):
        assert run.wait() == 0
        assert modes(terminal) == ECHO


def test_what_is_typed_to_a_program_that_does_not_read_is_bounded(tmp_path: Path) -> None:
    """Keys of a raw terminal: the kernel keeps some, we keep some, and the rest is refused."""
    loop = Loop()
    code = "import tty, time, os; tty.setraw(0); os.write(1, b'up'); time.sleep(100)"
    child = spawn(
        Spec("a", (sys.executable, "-E", "-c", code), dict(os.environ), str(tmp_path), tty=True, stdin=False)
    )
    seen: list[bytes] = []
    streams = [Stream(loop, descriptor, seen.append) for descriptor in child.outputs.values()]
    while b"up" not in b"".join(seen):
        loop.run_once()
    terminal = Terminal(loop, child.pid, child.outputs.values())
    taken = 0
    while size := terminal.write(b"x" * 1000):
        taken += size
    assert MOST_TYPED <= taken <= MOST_TYPED + 200_000
    os.kill(child.pid, signal.SIGKILL)
    for stream in streams:
        stream.close()
    terminal.close()
    child.reap()
    loop.close()
