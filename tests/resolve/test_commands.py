from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from orchestra.resolve.commands import run_command

_PATIENCE = 30.0
_ENVIRONMENT = {"PATH": os.defpath, "ODD": "a\nb=\udcff"}
_UNKEPT = "was ended because its keeper, the process above it, was ended"


def _python(script: str) -> tuple[str, ...]:
    return (sys.executable, "-I", "-c", script)


def _gone(pid: int) -> bool:
    """Tell whether a process is gone; one that waits to be reaped by a stranger is."""
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return True
    return state == "Z"


def _wait_until_gone(pid: int) -> None:
    deadline = time.monotonic() + _PATIENCE
    while not _gone(pid):
        assert time.monotonic() < deadline, f"process {pid} is still there"
        time.sleep(0.01)


def test_a_command_gives_its_output_and_status() -> None:
    result = run_command(("sh", "-c", "echo out; echo é >&2; exit 3"), _ENVIRONMENT)
    assert (result.status, result.stdout, result.stderr, result.failure) == (3, "out\n", "é\n", None)


def test_a_command_ended_by_a_signal_has_its_negative_number() -> None:
    assert run_command(("sh", "-c", "kill -TERM $$"), _ENVIRONMENT).status == -signal.SIGTERM


def test_a_command_has_exactly_the_given_environment_and_words() -> None:
    script = (
        "import os, sys; os.write(1, b'\\0'.join([*map(os.fsencode, sys.argv[1:]), os.environb[b'ODD']]))"
    )
    result = run_command((*_python(script), "", "a b", "$HOME"), _ENVIRONMENT)
    assert result.stdout == "\0a b\0$HOME\0a\nb=\N{REPLACEMENT CHARACTER}"
    shown = run_command(("env",), _ENVIRONMENT).stdout
    assert {line.partition("=")[0] for line in shown.splitlines() if "=" in line} == {"PATH", "ODD", "b"}


def test_a_command_has_no_input_no_foreign_descriptor_and_a_session_of_its_own() -> None:
    script = "import os, sys; print(sys.stdin.read() == '', os.getsid(0) == os.getpid(), os.listdir('/proc/self/fd'))"
    leaky = os.open(os.devnull, os.O_RDONLY)
    os.set_inheritable(leaky, True)
    try:
        result = run_command(_python(script), _ENVIRONMENT)
    finally:
        os.close(leaky)
    assert result.stdout == "True True ['0', '1', '2', '3']\n", "3 is the listed folder itself"


def test_a_command_has_no_signal_ignored_or_blocked() -> None:
    before = signal.signal(signal.SIGTERM, signal.SIG_IGN)
    blocked = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGUSR1})
    try:
        result = run_command(("sh", "-c", "grep -E 'Sig(Blk|Ign)' /proc/self/status"), _ENVIRONMENT)
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, blocked)
        signal.signal(signal.SIGTERM, before)
    internal = 0b11 << 31  # what glibc keeps for itself, and begins ignored where it spawns
    assert [int(line.split()[1], 16) & ~internal for line in result.stdout.splitlines()] == [0, 0]


@pytest.mark.parametrize(
    ("argv", "reason"),
    [
        (("nosuchprogram",), "No such file or directory"),
        (("/etc/passwd",), "Permission denied"),
        (("echo", "a\0b"), "embedded null byte"),
        (("echo", "x" * (1 << 20)), "Argument list too long"),
    ],
)
def test_what_cannot_be_started_says_why(argv: tuple[str, ...], reason: str) -> None:
    assert run_command(argv, _ENVIRONMENT).failure == f"cannot be started: {reason}"


@pytest.mark.conforms("D75")
def test_a_command_may_not_run_for_ever() -> None:
    result = run_command(
        ("sh", "-c", "trap '' INT TERM; echo begun; while :; do sleep 1; done"), _ENVIRONMENT, timeout=1
    )
    assert result.failure == "ran longer than 1 s"
    assert result.stdout in ("", "begun\n")  # a loaded machine may not have come so far


def test_a_command_may_not_print_without_end() -> None:
    result = run_command(("cat", "/dev/zero"), _ENVIRONMENT, limit=1 << 20)
    assert result.failure == "printed more than 1 MiB"
    assert len(result.stdout) < 1 << 21


def test_much_output_on_both_streams_comes_through() -> None:
    script = "import os\nfor _ in range(64):\n os.write(1, b'o' * 65536); os.write(2, b'e' * 65536)"
    result = run_command(_python(script), _ENVIRONMENT)
    assert (len(result.stdout), len(result.stderr), result.failure) == (1 << 22, 1 << 22, None)


# Each tells its number through a pipe with a name, and is waited for, before the command ends.
_LEFT_BEHIND = {
    "in the background": "sh -c 'echo $$ >$TOLD; exec sleep 1000' &",
    "in a session of its own": "setsid sh -c 'echo $$ >$TOLD; exec sleep 1000' &",
    "daemonised and deaf": "(setsid sh -c 'trap \"\" TERM INT HUP; echo $$ >$TOLD; exec sleep 1000' &);",
    "daemonised without its streams": "(setsid sh -c 'echo $$ >$TOLD; exec sleep 1000' >/dev/null 2>&1 &);",
}


@pytest.mark.parametrize("script", _LEFT_BEHIND.values(), ids=_LEFT_BEHIND)
def test_nothing_outlives_a_command(script: str, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "told")
    environment = {**_ENVIRONMENT, "TOLD": str(tmp_path / "told")}
    result = run_command(("sh", "-c", f"{script} read pid <$TOLD; echo $pid"), environment)
    assert (result.status, result.failure) == (0, None)
    assert _gone(int(result.stdout))


@pytest.mark.conforms("D75")
def test_nothing_outlives_a_command_that_ran_too_long() -> None:
    script = (
        "setsid sh -c 'echo $$; exec sleep 1000' & (setsid sh -c 'echo $$; exec sleep 1000' &); sleep 1000"
    )
    result = run_command(("sh", "-c", script), _ENVIRONMENT, timeout=2)
    assert result.failure == "ran longer than 2 s"
    for pid in result.stdout.split():
        assert _gone(int(pid))


_CALLER = """
import os
from orchestra.resolve.commands import run_command
run_command(("sh", "-c", "setsid sh -c 'echo $$ >>$PIDS; exec sleep 1000' & echo $$ >>$PIDS; exec sleep 1000"), os.environ)
"""


def _children_of(caller: subprocess.Popen[str], pids: Path, count: int) -> list[int]:
    """Wait until so many processes have written their numbers."""
    deadline = time.monotonic() + _PATIENCE
    while len(found := pids.read_text().split()) < count:
        assert caller.poll() is None
        assert time.monotonic() < deadline
        time.sleep(0.01)
    return [int(pid) for pid in found]


@pytest.mark.parametrize("ended_by", [signal.SIGKILL, signal.SIGINT])
def test_nothing_outlives_the_caller(ended_by: signal.Signals, tmp_path: Path) -> None:
    pids = tmp_path / "pids"
    pids.touch()
    environment = {**os.environ, "PIDS": str(pids)}
    words = [sys.executable, "-c", _CALLER]
    with subprocess.Popen(words, env=environment, stderr=subprocess.DEVNULL, text=True) as caller:
        left = _children_of(caller, pids, 2)
        caller.send_signal(ended_by)
    for pid in left:
        _wait_until_gone(pid)


_KEPT = """
(setsid sh -c 'trap "" TERM INT HUP; echo $$ >>$PIDS; exec sleep 1000' &)
env -i setsid sleep 1000 & echo $! >>$PIDS
sleep 1000 >/dev/null 2>&1 & echo $! >>$PIDS
until [ $(wc -l <$PIDS) = 3 ]; do sleep 0.02; done
echo $$ >>$PIDS; kill -NUMBER $PPID; wait
"""


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP])
def test_nothing_outlives_its_reaper(number: signal.Signals, tmp_path: Path) -> None:
    """The command itself ends the process above it, once everything below the command runs."""
    bystander = subprocess.Popen(["sleep", "1000"])
    environment = {**_ENVIRONMENT, "PIDS": str(tmp_path / "pids")}
    (tmp_path / "pids").touch()
    try:
        result = run_command(
            ("sh", "-c", _KEPT.replace("NUMBER", str(int(number)))), environment, timeout=300
        )
        assert bystander.poll() is None, "what was there before is not touched"
    finally:
        bystander.kill()
        bystander.wait()
    assert (result.failure, result.stderr) == (_UNKEPT, "")
    pids = (tmp_path / "pids").read_text().split()
    assert len(pids) == 4
    assert all(_gone(int(pid)) for pid in pids)


def test_a_stopped_reaper_is_no_refuge() -> None:
    """It cannot act on losing its caller; so it is killed, and what it had below it ended."""
    result = run_command(
        ("sh", "-c", "(setsid sleep 1000 & echo $!); kill -STOP $PPID; sleep 1000"), _ENVIRONMENT, timeout=1
    )
    assert result.failure == "ran longer than 1 s"
    assert all(_gone(int(pid)) for pid in result.stdout.split())


def test_a_reaper_that_does_not_begin_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    """The order is larger than a pipe holds, so that writing it meets the closed end."""
    monkeypatch.setattr(sys, "executable", "/bin/false")
    result = run_command(("true",), {"LARGE": "x" * (1 << 20)})
    assert result.failure == _UNKEPT


def test_no_descriptor_is_left_open() -> None:
    run_command(("true",), _ENVIRONMENT)
    before = len(list(Path("/proc/self/fd").iterdir()))
    run_command(("true",), _ENVIRONMENT)
    run_command(("sleep", "1000"), _ENVIRONMENT, timeout=0.1)
    run_command(("nosuchprogram",), _ENVIRONMENT)
    assert len(list(Path("/proc/self/fd").iterdir())) == before
