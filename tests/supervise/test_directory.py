from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.directory import create, prune, state_folder

if TYPE_CHECKING:
    from pathlib import Path


def test_runs_of_the_same_second_do_not_share_a_directory(tmp_path: Path) -> None:
    runs = [create(tmp_path, "two robots/../x") for _ in range(3)]
    assert len({run.path for run in runs}) == 3
    assert all(run.path.parent == tmp_path and "two-robots-..-x" in run.path.name for run in runs)
    for run in runs:
        run.release()


def test_old_runs_go_and_running_ones_and_strangers_stay(tmp_path: Path) -> None:
    for number in range(10):
        folder = tmp_path / f"20200101-00000{number}-old"
        folder.mkdir()
        (folder / "lock").touch()
    (tmp_path / "mine").mkdir()
    (tmp_path / "20200101-000000-half-made").mkdir()
    running = create(tmp_path, "running")
    running.path.rename(tmp_path / "20190101-000000-running")
    prune(tmp_path, keep=3)
    left = sorted(entry.name for entry in tmp_path.iterdir())
    assert left == [
        "20190101-000000-running",
        "20200101-000000-half-made",
        *(f"20200101-00000{number}-old" for number in (7, 8, 9)),
        "mine",
    ]
    running.release()
    prune(tmp_path, keep=3)
    assert not (tmp_path / "20190101-000000-running").exists()


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
