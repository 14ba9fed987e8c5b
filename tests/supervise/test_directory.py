from __future__ import annotations

import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.keeping import proc
from orchestra.supervise.runs import identity, registry, running
from orchestra.supervise.runs.directory import NameTakenError, create, prune, state_folder

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.supervise.runs.directory import RunDirectory
    from orchestra.supervise.runs.identity import Identity


def _identity(name: str) -> Identity:
    return identity.identity("mark", name, "a.yaml", os.getpid())


def _begun(runs: Path, name: str, *, exact: bool = False) -> RunDirectory:
    return create(runs, _identity(name), exact=exact)


def test_runs_of_the_same_second_do_not_share_a_directory(tmp_path: Path) -> None:
    runs = [_begun(tmp_path, "two robots/../x") for _ in range(3)]
    assert len({run.path for run in runs}) == 3
    assert all(run.path.parent == tmp_path and "two-robots-..-x" in run.path.name for run in runs)
    for run in runs:
        run.release()


def test_living_runs_have_names_of_their_own(tmp_path: Path) -> None:
    runs = [_begun(tmp_path, "two_robots") for _ in range(3)]
    assert [run.name for run in runs] == ["two_robots", "two_robots-2", "two_robots-3"]
    assert [run.name for run in registry.living(tmp_path)] == [run.name for run in runs]
    runs[1].release()
    again = _begun(tmp_path, "two_robots")
    assert again.name == "two_robots-2"
    for run in (runs[0], runs[2], again):
        run.release()
    assert _begun(tmp_path, "two_robots").name == "two_robots"


def test_a_name_that_was_asked_for_stays_or_nothing_begins(tmp_path: Path) -> None:
    run = _begun(tmp_path, "mine", exact=True)
    with pytest.raises(NameTakenError, match="mine") as caught:
        _begun(tmp_path, "mine", exact=True)
    assert caught.value.directory == run.path
    assert len(registry.folders(tmp_path)) == 1
    run.release()
    _begun(tmp_path, "mine", exact=True).release()


def test_runs_that_begin_at_once_do_not_share_a_name(tmp_path: Path) -> None:
    with ThreadPoolExecutor(8) as pool:
        runs = list(pool.map(lambda _: _begun(tmp_path, "same"), range(24)))
    assert len({run.name for run in runs}) == 24
    for run in runs:
        run.release()


def test_a_run_that_ended_is_known_by_name_still(tmp_path: Path) -> None:
    run = _begun(tmp_path, "two_robots")
    run.release()
    assert not registry.living(tmp_path)
    assert not running.unfinished(str(tmp_path))
    assert registry.name_of(run.path) == "two_robots"
    (run.path / running.ENDED).unlink()
    assert registry.name_of(run.path) == "two_robots"


def test_a_run_that_died_is_told_from_one_that_lives_and_one_whose_keeper_still_clears_up(
    tmp_path: Path,
) -> None:
    run = _begun(tmp_path, "killed")
    assert not running.abandoned(str(tmp_path))
    os.close(run._lock)  # as the kernel does when the supervisor dies
    assert running.abandoned(str(tmp_path)) == [run.path.name]
    assert not registry.living(tmp_path)
    assert not registry.dead(tmp_path)  # the keeper is this process
    ended = subprocess.Popen([sys.executable, "-c", ""])
    birth = proc.birth(ended.pid)
    identity.write(run.path, replace(run.identity, keeper=ended.pid, keeper_birth=birth))
    ended.wait()
    assert [found.name for found in registry.dead(tmp_path)] == ["killed"]
    identity.write(run.path, replace(run.identity, keeper_birth=1))
    assert [found.name for found in registry.dead(tmp_path)] == ["killed"]
    identity.settle(run.path)
    assert not running.abandoned(str(tmp_path))


def test_a_run_that_leaves_processes_stays_one_to_look_after(tmp_path: Path) -> None:
    run = _begun(tmp_path, "stuck")
    run.release(settled=False)
    assert running.abandoned(str(tmp_path)) == [run.path.name]


def test_what_is_no_identity_is_no_run(tmp_path: Path) -> None:
    for text in ("", "[]", "{}", '{"run": 1, "unknown": 2}'):
        (tmp_path / running.RUNNING).write_text(text)
        assert identity.read(tmp_path) is None
    run = _begun(tmp_path / "runs", "a")
    (run.path / running.RUNNING).write_text("{}")
    assert not registry.living(tmp_path / "runs")
    run.release()


def test_the_birth_of_a_process_is_its_own() -> None:
    child = subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)
    born = proc.birth(child.pid)
    ours = proc.birth(os.getpid())
    assert born is not None
    assert ours is not None
    assert born >= ours
    child.kill()
    os.waitid(os.P_PID, child.pid, os.WEXITED | os.WNOWAIT)
    assert proc.birth(child.pid) is None
    child.communicate()


def test_old_runs_go_and_running_ones_and_strangers_stay(tmp_path: Path) -> None:
    for number in range(10):
        folder = tmp_path / f"20200101-00000{number}-old"
        folder.mkdir()
        (folder / "lock").touch()
    (tmp_path / "mine").mkdir()
    (tmp_path / "20200101-000000-half-made").mkdir()
    alive = _begun(tmp_path, "running")
    alive.path = alive.path.rename(tmp_path / "20190101-000000-running")
    died = tmp_path / "20180101-000000-died"
    shutil.copytree(alive.path, died)
    prune(tmp_path, keep=3)
    left = sorted(entry.name for entry in tmp_path.iterdir())
    assert left == [
        "20180101-000000-died",
        "20190101-000000-running",
        "20200101-000000-half-made",
        *(f"20200101-00000{number}-old" for number in (7, 8, 9)),
        "mine",
    ]
    alive.release()
    prune(tmp_path, keep=3)
    assert not alive.path.exists()
    assert died.exists()


@pytest.mark.conforms("4.10 base", "D70")
def test_where_runs_are_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("ORCHESTRA_HOME", raising=False)
    monkeypatch.delenv("XDG_STATE_HOME", raising=False)
    monkeypatch.setenv("HOME", str(tmp_path))
    assert state_folder() == tmp_path / ".local" / "state" / "orchestra"
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    assert state_folder() == tmp_path / "state" / "orchestra"
    monkeypatch.setenv("ORCHESTRA_HOME", str(tmp_path / "here"))
    assert state_folder() == tmp_path / "here"
