"""Job control, and terminals that are closed, stopped or in the background: nobody is blocked, the run goes on."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import termios
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.keeping import proc
from orchestra.supervise.options import RunOptions
from orchestra.supervise.resolver import document
from tests.supervise.plans import PROCESSES, launched, name_of, plan, process, wait_for
from tests.supervise.test_terminal import Terminal, in_terminal

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

POLITE = process("polite", "polite", "say=up", "linger")
# It talks on as long as it runs, so that output meets a terminal that is the shell's.
CLOCK = process("clock", command=("/bin/sh", "-c", "while :; do echo tick; sleep 0.1; done"))


class Shell:
    """A real shell with job control on a terminal of its own, and the run that is started from it."""

    def __init__(self, folder: Path, terminal: Terminal, shell: int) -> None:
        self.terminal = terminal
        self._shell = shell
        self._home = folder / "home"
        path = folder / "document.json"
        path.write_bytes(document.dumps(plan(POLITE, CLOCK), RunOptions()))
        self.command = f"{sys.executable} {PROCESSES / 'launcher.py'} {path}"

    def type(self, text: str) -> None:
        self.terminal.type(text.encode())

    def await_text(self, text: str) -> None:
        wait_for(lambda: text.encode() in self.terminal.read(), f"{text!r} on the terminal")

    def await_ticks(self) -> None:
        """Wait until the clock has gone on."""
        seen = self.ticks()
        wait_for(lambda: self.ticks() > seen + 5, "the clock to go on")

    def ticks(self) -> int:
        return sum(path.read_text().count("tick\n") for path in self._home.glob("runs/*/logs/clock.log"))

    def keeper(self) -> int:
        found = [pid for pid in proc.descendants(self._shell) if name_of(pid) == "orc-keeper"]
        return found[0] if found else 0

    def supervisor(self) -> int:
        found = [pid for pid in proc.descendants(self._shell) if name_of(pid) == "orc-supervisor"]
        return found[0] if found else 0

    def await_state(self, states: str) -> None:
        """Wait for a state of the keeper."""

        def reached() -> bool:
            facts = proc.stat(self.keeper())
            return facts is not None and facts.state in states

        wait_for(reached, f"the keeper to be in one of the states {states}")


@pytest.fixture
def shell(tmp_path: Path) -> Iterator[Shell]:
    """A shell in a terminal; what it started is killed with it."""
    terminal = Terminal()
    pid = os.fork()
    if pid == 0:
        os.setsid()
        os.close(os.open(os.ttyname(terminal.theirs), os.O_RDWR))
        for number in range(3):
            os.dup2(terminal.theirs, number)
        environment = {**os.environ, "ORCHESTRA_HOME": str(tmp_path / "home"), "PS1": "$ ", "TERM": "dumb"}
        os.execve("/bin/bash", ["bash", "--norc", "--noprofile", "-i"], environment)  # noqa: S606
    os.close(terminal.theirs)
    try:
        yield Shell(tmp_path, terminal, pid)
    finally:
        for below in [*proc.descendants(pid), pid]:
            with contextlib.suppress(ProcessLookupError):
                os.kill(below, signal.SIGKILL)
        os.waitpid(pid, 0)
        os.close(terminal.ours)


def test_ctrl_z_gives_the_shell_its_prompt_back_and_the_run_goes_on(shell: Shell) -> None:
    shell.type(shell.command + "\n")
    wait_for(lambda: shell.ticks() > 2, "the run")
    shell.type("\x1a")
    shell.await_text("suspended, but the run goes on")
    shell.await_state("T")
    shell.type("echo it is $((1 + 1))\n")
    shell.await_text("it is 2")
    assert proc.stat(shell.supervisor()).state in "SRD"  # type: ignore[union-attr]
    shell.await_ticks()
    shell.type("bg\n")
    shell.await_state("S")
    shell.await_ticks()
    shell.type("fg\n")
    wait_for(lambda: proc.in_foreground(shell.keeper()), "the keeper in the foreground")
    shell.type("\x03")
    shell.await_text("SIGINT: stopping")
    shell.type("echo status $?\n")
    shell.await_text("status 130")
    shell.await_text("bye")


def test_a_run_in_the_background_is_not_stopped_by_what_it_writes(shell: Shell) -> None:
    """`stty tostop` stops who writes to the terminal in the background; we are told what happens all the same."""
    shell.type("stty tostop\n")
    shell.type(shell.command + " &\n")
    shell.await_text("[clock]")
    supervisor = shell.supervisor()
    assert not proc.in_foreground(shell.keeper())
    shell.await_ticks()
    os.kill(supervisor, signal.SIGKILL)
    shell.await_text("the supervisor was ended by SIGKILL")
    wait_for(lambda: not shell.keeper(), "the end of the keeper")


def test_a_suspended_run_ends_when_its_shell_does(shell: Shell) -> None:
    shell.type(shell.command + "\n")
    wait_for(lambda: shell.ticks() > 2, "the run")
    keeper, supervisor = shell.keeper(), shell.supervisor()
    shell.type("\x1a")
    shell.await_state("T")
    shell.type("exit\nexit\n")
    wait_for(lambda: proc.stat(supervisor) is None, "the end of the supervisor")
    wait_for(lambda: proc.stat(keeper) is None or proc.stat(keeper).state == "Z", "the end of the keeper")  # type: ignore[union-attr]


def test_what_nobody_could_continue_is_not_suspended(tmp_path: Path) -> None:
    """The keeper leads the session of its terminal, as `ssh -t host orchestra launch` has it."""
    with in_terminal(tmp_path, POLITE) as (run, terminal):
        run.await_line("polite", "up")
        terminal.type(b"\x1a")
        terminal.type(b"\x03")
        assert run.wait() == 130
        assert b"suspended" not in terminal.read()


def test_a_stopped_terminal_blocks_nobody(tmp_path: Path) -> None:
    """Ctrl-S, and nobody goes on with Ctrl-Q: neither the processes nor the end wait for it."""
    with in_terminal(tmp_path, POLITE, CLOCK) as (run, terminal):
        run.await_line("polite", "up")
        terminal.type(b"\x13")
        log = run.directory / "logs" / "clock.log"
        seen = log.read_text().count("tick")
        wait_for(lambda: log.read_text().count("tick") > seen + 5, "the clock to go on")
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert run.log("polite") == "up\nbye\n"


def _unread(_run: object, _terminal: Terminal) -> None:
    """Let the terminal fill up."""


def _stop(_run: object, terminal: Terminal) -> None:
    terminal.type(b"\x13")


@pytest.mark.parametrize("hinder", [_unread, _stop])
def test_a_keeper_that_has_to_tell_something_is_not_blocked(
    tmp_path: Path, hinder: Callable[[object, Terminal], None]
) -> None:
    noisy = process("noisy", "bytes=1200000", "say=done", "linger")
    with in_terminal(tmp_path, noisy) as (run, terminal):
        run.await_line("noisy", "done")
        hinder(run, terminal)
        os.kill(run.own("orc-supervisor"), signal.SIGKILL)
        assert run.wait() == 1
        run.assert_gone()


def test_a_closed_terminal_while_the_resolver_works(tmp_path: Path) -> None:
    terminal = Terminal()

    def take_terminal() -> None:
        os.setsid()
        signal.pthread_sigmask(signal.SIG_SETMASK, ())
        os.close(os.open(os.ttyname(terminal.theirs), os.O_RDWR))

    theirs = terminal.theirs
    with launched(
        tmp_path, ("wait",), preexec_fn=take_terminal, stdin=theirs, stdout=theirs, stderr=theirs
    ) as run:
        os.close(terminal.theirs)
        wait_for(lambda: b"resolving" in terminal.read(), "the resolver")
        os.close(terminal.ours)
        assert run.wait() == 129
        run.assert_gone()


SIZE = 'while :; do new=$(stty size); [ "$new" = "$old" ] || echo "$new"; old=$new; sleep 0.05; done'


@pytest.mark.parametrize("late", [False, True], ids=["at once", "while suspended"])
def test_a_change_of_size_reaches_the_terminals_of_programs(tmp_path: Path, *, late: bool) -> None:
    measuring = process("a", command=("/bin/sh", "-c", SIZE), emulate_tty=True)
    with in_terminal(tmp_path, measuring) as (run, terminal):
        termios.tcsetwinsize(terminal.ours, (33, 111))
        run.await_line("a", "33 111")
        if late:
            run.send(signal.SIGSTOP)
        termios.tcsetwinsize(terminal.ours, (50, 200))
        if late:
            run.send(signal.SIGCONT)
        run.await_line("a", "50 200")
        run.send(signal.SIGINT)
        assert run.wait() == 130
