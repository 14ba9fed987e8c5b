"""What a command ends with where its supervisor is killed, or cannot be started."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

_KEEPING = """
import os
from orchestra.supervise.keeping.keeper import keep
from orchestra.supervise.keeping.patience import Patience
from orchestra.supervise.keeping.stacks import Stacks

patience, told = Patience(), TOLD

def supervise():
    if told is not None:
        patience.settle(told)
    os.kill(os.getpid(), 9)

raise SystemExit(keep(supervise, patience, Stacks(), lambda: None))
"""
_WITHOUT_ROOM = """
import errno, os
from orchestra.supervise.run import run

fork = os.fork
forks = []

def scarce():
    forks.append(None)
    if len(forks) > ROOM:
        raise BlockingIOError(errno.EAGAIN, os.strerror(errno.EAGAIN))
    return fork()

os.fork = scarce
raise SystemExit(run(lambda _stream: 0))
"""
_WITHOUT_A_THREAD = """
import threading
from orchestra.supervise.options import RunOptions
from orchestra.supervise.resolver.document import dumps
from orchestra.supervise.run import run
from tests.supervise.plans import plan

def none(_thread):
    raise RuntimeError("can't start new thread")

def prepare(stream):
    stream.write(dumps(plan(), RunOptions()))
    return 0

threading.Thread.start = none
raise SystemExit(run(prepare))
"""


def ended(program: str, **environment: str) -> tuple[int, str]:
    """Carry out a program and return its status and what it has told."""
    done = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, **environment},
        cwd=Path(__file__).parents[2],
    )
    return done.returncode, done.stderr


@pytest.mark.parametrize(("told", "status"), [(130, 130), (0, 0), (None, 1)])
def test_a_supervisor_that_is_killed_changes_no_outcome_that_it_has_told(
    told: int | None, status: int
) -> None:
    assert ended(_KEEPING.replace("TOLD", str(told))) == (
        status,
        "[orchestra] the supervisor was ended by SIGKILL; everything that it had started has been ended\n",
    )


@pytest.mark.parametrize("room", [0, 1], ids=["for the supervisor", "for the resolver"])
def test_a_run_that_finds_no_room_for_a_process_says_so(room: int) -> None:
    assert ended(_WITHOUT_ROOM.replace("ROOM", str(room))) == (
        1,
        "[orchestra] the run cannot begin, for no process can be started: Resource temporarily unavailable\n",
    )


def test_a_run_that_finds_no_room_for_a_thread_says_so(tmp_path: Path) -> None:
    assert ended(_WITHOUT_A_THREAD, ORCHESTRA_HOME=str(tmp_path)) == (
        1,
        "[orchestra] the run cannot begin: can't start new thread\n",
    )
