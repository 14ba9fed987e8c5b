"""Both ways of starting a program give it the same: what it inherits, where it is found, why it cannot be started."""

from __future__ import annotations

import os
import resource
import signal
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.logs.rotation import OPENING
from orchestra.supervise.process.spawn import spawn
from orchestra.supervise.process.spec import Spec

if TYPE_CHECKING:
    from collections.abc import Callable

# The second one forks: there is something to do in the child.
WAYS: tuple[Callable[[], None] | None, ...] = (None, lambda: None)
MARK = 123456
# The soft limit is so low that more is taken from the first program on. What it tells of itself comes behind.
LIMITED = """
import resource, sys, threading
resource.setrlimit(resource.RLIMIT_NOFILE, (8, resource.getrlimit(resource.RLIMIT_NOFILE)[1]))
from orchestra.logs.rotation import OPENING
from tests.supervise.test_spawn import told
if sys.argv[1] == "busy":
    threading.Thread(target=OPENING.acquire, daemon=True).start()
    while OPENING.acquire(blocking=False):
        OPENING.release()
print(told(("/bin/sh", "-c", "ulimit -S -n")), resource.getrlimit(resource.RLIMIT_NOFILE)[0] > 8)
"""


def told(
    command: tuple[str, ...],
    cwd: str | None = None,
    before: Callable[[], None] | None = None,
    **environment: str,
) -> str:
    """Start a program and return all that it writes before it ends with 0."""
    own = {"PATH": os.environ["PATH"], **environment}
    child = spawn(Spec("a", command, own, cwd, tty=False, stdin=False, before_exec=before, mark=MARK))
    os.set_blocking(child.outputs["stdout"], True)
    with os.fdopen(child.outputs["stdout"]) as output:
        text = output.read().strip()
    os.waitid(os.P_PID, child.pid, os.WEXITED | os.WNOWAIT)
    assert child.ended() == (0, None)
    child.reap()
    os.close(child.outputs["stderr"])
    return text


@pytest.mark.parametrize("before", WAYS)
def test_a_program_begins_where_it_should_and_we_stay(
    tmp_path: Path, before: Callable[[], None] | None
) -> None:
    here = Path.cwd()
    (tmp_path / "tool").symlink_to("/bin/pwd")
    assert told(("./tool", "-P"), str(tmp_path), before) == str(tmp_path.resolve())
    assert Path.cwd() == here


@pytest.mark.parametrize("before", WAYS)
def test_it_is_found_by_its_own_search_path(tmp_path: Path, before: Callable[[], None] | None) -> None:
    (tmp_path / "folder" / "tool").mkdir(parents=True)
    (tmp_path / "tool").symlink_to("/bin/echo")
    assert told(("tool", "x"), None, before, PATH=f"{tmp_path / 'folder'}:{tmp_path}") == "x"
    assert told(("tool", "y"), str(tmp_path), before, PATH=":/nowhere") == "y"


@pytest.mark.parametrize("before", WAYS)
def test_it_has_its_number_and_we_keep_ours(before: Callable[[], None] | None) -> None:
    locks = 10
    ours = resource.getrlimit(locks)
    lines = told(("/bin/cat", "/proc/self/limits"), None, before).splitlines()
    assert next(line for line in lines if line.startswith("Max file locks")).split()[3] == str(MARK)
    assert resource.getrlimit(locks) == ours


@pytest.mark.parametrize("before", WAYS)
@pytest.mark.parametrize(
    ("command", "cwd", "wrong"),
    [
        (("/nowhere/tool",), None, "/nowhere/tool"),
        (("surely-no-such-tool",), None, "surely-no-such-tool"),
        (("/bin/true",), "/nowhere", "/nowhere"),
        (("/etc/passwd",), None, "/etc/passwd"),
    ],
)
def test_what_cannot_be_started_is_named(
    command: tuple[str, ...], cwd: str | None, wrong: str, before: Callable[[], None] | None
) -> None:
    open_before = sorted(Path("/proc/self/fd").iterdir())
    with pytest.raises(OSError) as caught:  # noqa: PT011 - which one is the system's choice
        told(command, cwd, before)
    assert caught.value.filename == wrong
    assert sorted(Path("/proc/self/fd").iterdir()) == open_before


@pytest.mark.parametrize("before", WAYS)
def test_a_word_with_a_zero_cannot_be_given(before: Callable[[], None] | None) -> None:
    with pytest.raises(OSError, match="a byte that is 0"):
        told(("/bin/echo", "a\0b"), None, before)
    with pytest.raises(OSError, match="a byte that is 0"):
        told(("/bin/echo",), None, before, NAME="a\0b")


@pytest.mark.parametrize("thread", ["idle", "busy"])
def test_a_program_has_the_limit_that_we_were_given(thread: str) -> None:
    """Also where the thread that writes is just opening a file, for which the limit must not be lowered."""
    command = [sys.executable, "-c", LIMITED, thread]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=Path(__file__).parents[2])
    assert done.stdout.split() == ["8", "True"]


def test_no_lock_is_left() -> None:
    assert told(("/bin/echo", "x")) == "x"
    assert OPENING.acquire(blocking=False)
    OPENING.release()
    assert signal.getsignal(signal.SIGPIPE) == signal.SIG_IGN
