"""What is left of runs whose keeper, supervisor and guard were killed in the same instant; how it is found and ended."""

from __future__ import annotations

import os
import pty
import select
import signal
import subprocess
import sys
import time
import uuid
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

import pytest

from orchestra.cli.detaching import BEGINNING
from orchestra.control import door
from orchestra.supervise.runs import registry, running
from tests.supervise.plans import PATIENCE, alive, launched, plan, process, wait_for

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from subprocess import CompletedProcess

    from tests.supervise.plans import Launched

    Command: TypeAlias = Callable[..., CompletedProcess[str]]

STUBBORN = process("/stubborn", "ignore=INT,TERM", "daemon=ignore", "say=up", "linger")
# The program and its daemon.
LEFT = 2


@pytest.fixture
def left(tmp_path: Path) -> Iterator[set[int]]:
    """What a run leaves that is killed as a whole."""
    with launched(tmp_path, plan(STUBBORN)) as run:
        yield _killed(run)


def _killed(run: Launched) -> set[int]:
    run.await_line("stubborn", "up")
    ours = {run.popen.pid, run.own("orc-supervisor"), run.own("orc-guard")}
    below = run.everything() - ours
    for pid in ours:
        os.kill(pid, signal.SIGSTOP)
    for pid in ours:
        os.kill(pid, signal.SIGKILL)
    run.popen.wait()
    wait_for(lambda: not any(map(alive, ours)), "their end")
    return {pid for pid in below if alive(pid)}


def test_every_command_about_runs_tells_of_them(left: set[int], orchestra: Command, home: Path) -> None:
    assert len(left) == LEFT
    for words in (("ps",), ("events",), ("down",)):
        found = orchestra(*words)
        assert "warning: run 'run' died and left 2 processes: " in found.stderr
        assert found.stderr.count("stubborn (pid ") == 2
        assert "; 'orchestra clean' ends them" in found.stderr
    untouched: tuple[tuple[str, ...], ...] = (("ps", "--help"), ("schema", "plan"), ("--version",))
    for others in untouched:
        assert orchestra(*others).stderr == ""
    assert all(map(alive, left))
    assert running.abandoned(str(home / "runs"))


def test_a_launch_tells_of_them_and_does_its_work(left: set[int], orchestra: Command, folder: Path) -> None:
    (folder / "a.launch.yaml").write_text("launch: [{executable: {cmd: echo hello}}]\n")
    found = orchestra("launch", "a.launch.yaml")
    assert found.returncode == 0
    assert "hello" in found.stdout
    assert "died and left 2 processes" in found.stderr
    assert all(map(alive, left))


def test_clean_asks_where_nobody_can_answer_and_ends_them_with_yes(
    left: set[int], orchestra: Command, home: Path
) -> None:
    (directory,) = (home / "runs").iterdir()
    path = door.linked(directory)
    assert path is not None
    # A process is as good as dead before the last of its threads has let go of its files.
    wait_for(lambda: door.is_stale(path), "the end of the supervisor's socket")
    found = orchestra("clean")
    assert found.returncode == 1
    assert "'orchestra clean --yes' ends them" in found.stderr
    assert all(map(alive, left))
    (home / "runs" / f"{BEGINNING}999999999").write_text("")
    begins = home / "runs" / f"{BEGINNING}{os.getpid()}"
    begins.write_text("")
    memory = [Path(f"/dev/shm/fastrtps_{uuid.uuid4().hex[:16]}")]  # noqa: S108
    memory.append(Path(f"{memory[0]}_el"))
    for file in memory:
        file.write_text("")
    found = orchestra("clean", "--yes")
    assert found.returncode == 0, found.stderr
    assert "2 processes ended" in found.stdout
    assert not any(map(alive, left))
    assert not any(file.exists() for file in memory)
    assert not os.path.lexists(path)
    assert not running.unfinished(str(home / "runs"))
    assert [entry.name for entry in (home / "runs").iterdir() if entry.name.startswith(".")] == [begins.name]
    found = orchestra("clean")
    assert (found.returncode, found.stderr) == (0, "")
    assert found.stdout == "0 processes ended, 0 files removed\n"
    assert orchestra("ps").stderr == "no run is alive\n"


def test_what_lives_is_left_alone(left: set[int], orchestra: Command, home: Path, folder: Path) -> None:
    (folder / "a.launch.yaml").write_text("launch: [{executable: {cmd: sleep 1000, name: a}}]\n")
    assert orchestra("launch", "--detach", "a.launch.yaml").returncode == 0
    assert orchestra("clean", "-y").returncode == 0
    assert not any(map(alive, left))
    (run,) = registry.living(home / "runs")
    assert alive(run.identity.keeper)
    assert orchestra("restart", "a").returncode == 0
    assert orchestra("down").returncode == 0


def test_a_run_that_died_and_left_nothing_is_put_in_order_without_a_word(
    tmp_path: Path, orchestra: Command, home: Path
) -> None:
    with launched(tmp_path, plan(STUBBORN)) as run:
        for pid in _killed(run):
            os.kill(pid, signal.SIGKILL)
        wait_for(lambda: not run.everything(), "the end of all")
        (directory,) = (home / "runs").iterdir()
        path = door.linked(directory)
        found = orchestra("ps")
        assert (found.returncode, found.stderr) == (0, "no run is alive\n")
        assert path is not None
        assert not os.path.lexists(path)
        assert not running.unfinished(str(home / "runs"))


def test_a_killed_supervisor_leaves_no_socket(tmp_path: Path) -> None:
    with launched(tmp_path, plan(STUBBORN)) as run:
        run.await_line("stubborn", "up")
        path = door.linked(run.directory)
        assert path is not None
        assert os.path.lexists(path)
        os.kill(run.own("orc-supervisor"), signal.SIGKILL)
        assert run.wait() == 1
        assert not os.path.lexists(path)
        run.assert_gone()


def test_a_killed_keeper_leaves_no_socket_and_no_unfinished_run(tmp_path: Path, home: Path) -> None:
    with launched(tmp_path, plan(STUBBORN)) as run:
        run.await_line("stubborn", "up")
        path = door.linked(run.directory)
        assert path is not None
        os.kill(run.popen.pid, signal.SIGKILL)
        run.assert_gone()
        assert not os.path.lexists(path)
        assert not running.unfinished(str(home / "runs"))


@pytest.mark.parametrize(
    ("answer", "ends"), [(b"y\n", True), (b"\n", False), (b"n\n", False), (b"\x04", False)]
)
def test_at_a_terminal_the_user_is_asked(left: set[int], home: Path, answer: bytes, ends: bool) -> None:
    status, shown = _at_a_terminal(home, b"[y/N]", answer)
    assert b"End them now? [y/N]" in shown
    assert b"no run is alive" in shown
    assert status == 0
    assert any(map(alive, left)) != ends


def test_ctrl_c_at_the_question_ends_the_command(left: set[int], home: Path) -> None:
    status, shown = _at_a_terminal(home, b"[y/N]", b"\x03")
    assert status == 130
    assert b"no run is alive" not in shown
    assert all(map(alive, left))


def _at_a_terminal(home: Path, question: bytes, answer: bytes) -> tuple[int, bytes]:
    """Run `orchestra ps` at a terminal of its own, answer it, and return its status and all that was shown."""
    pid, terminal = pty.fork()
    if not pid:
        os.environ["ORCHESTRA_HOME"] = str(home)
        os.execv(sys.executable, [sys.executable, "-m", "orchestra", "ps"])  # noqa: S606
    shown = b""
    answered = False
    deadline = time.monotonic() + PATIENCE
    while True:
        assert time.monotonic() < deadline, shown
        if not select.select([terminal], [], [], 0.1)[0]:
            continue
        try:
            data = os.read(terminal, 4096)
        except OSError:
            break
        shown += data
        if question in shown and not answered:
            answered = True
            os.write(terminal, answer)
    os.close(terminal)
    return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]), shown


def test_a_start_pays_next_to_nothing(tmp_path: Path) -> None:
    """Where no run has died, a start looks for one without reading anything of /proc."""
    trace = (
        "import sys, orchestra.__main__ as m\n"
        "seen = []\n"
        "sys.addaudithook(lambda name, given: seen.append((name, given)) if name in ('open', 'os.listdir') else None)\n"
        "assert m._look_after_the_dead() == 0\n"
        "assert not [one for one in seen if '/proc' in str(one[1])], seen\n"
        "assert 'orchestra.cli' not in sys.modules and 'json' not in sys.modules\n"
    )
    runs = tmp_path / "home" / "runs"
    for number in range(5):
        (runs / f"20200101-00000{number}-old").mkdir(parents=True)
        (runs / f"20200101-00000{number}-old" / running.ENDED).write_text("{}")
    subprocess.run(
        [sys.executable, "-S", "-E", "-c", f"import sys; sys.path = {sys.path!r}\n{trace}"],
        env={**os.environ, "ORCHESTRA_HOME": str(tmp_path / "home")},
        timeout=PATIENCE,
        check=True,
    )
