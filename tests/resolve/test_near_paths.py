"""Looking for the files that were meant takes an end, however many are missing of a folder that has many."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from orchestra.nearest import renew
from orchestra.resolve.near_paths import near_names, near_path, related_names

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


@pytest.fixture(autouse=True)
def _begun() -> Iterator[None]:
    renew()
    yield
    renew()


def _listings(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Return the list of the folders that are read from now on."""
    read, scandir = list[str](), os.scandir

    def counted(folder: str) -> Iterator[os.DirEntry[str]]:
        read.append(folder)
        return scandir(folder)

    monkeypatch.setattr("orchestra.resolve.near_paths.os.scandir", counted)
    return read


def test_a_folder_is_read_once_for_all_that_is_missing_in_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for number in range(20):
        (tmp_path / f"robot_{number}.yaml").touch()
    (tmp_path / "ekf.yaml").touch()
    read = _listings(monkeypatch)
    for number in range(20):
        assert near_path(tmp_path / f"roobt_{number}.yaml", f"roobt_{number}.yaml") == f"robot_{number}.yaml"
        assert related_names(tmp_path / "ekf_params.yaml") == (("ekf_params.yaml", "ekf.yaml"),)
    assert read == [str(tmp_path)]


def test_a_file_that_has_come_since_is_found_for_the_next_launch_file(tmp_path: Path) -> None:
    assert near_names(tmp_path / "roobt.yaml") == ()
    (tmp_path / "robot.yaml").touch()
    renew()
    assert near_names(tmp_path / "roobt.yaml") == (("roobt.yaml", "robot.yaml"),)


def test_folders_below_are_not_looked_through_for_ever(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A thousand files that are missing are looked for in a hundred folders ten times, not a thousand."""
    folder = tmp_path / "share" / "maps"
    for number in range(100):
        (folder / f"f{number}").mkdir(parents=True)
    (folder / "f7" / "map.pgm").touch()
    looks = list[str]()

    def nothing(path: str) -> bool:
        looks.append(str(path))
        return False

    monkeypatch.setattr("orchestra.resolve.near_paths.is_file", nothing)
    monkeypatch.setattr("orchestra.nearest._left", [3_000])
    for number in range(1_000):
        near_names(folder / f"{number}.pgm")
    assert 1_000 <= len(looks) <= 5_000
    monkeypatch.undo()
    renew()
    assert near_names(folder / "map.pgm") == (("map.pgm", "f7/map.pgm"),)


def test_no_folder_that_is_not_there_or_cannot_be_named_has_near_names(tmp_path: Path) -> None:
    assert near_names(tmp_path / "a\0b.yaml") == ()
    assert related_names(tmp_path / "none" / "a.yaml") == ()
