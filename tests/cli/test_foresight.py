"""Whether nodes in Python are likely is told by the launch file, and by the plan that is remembered."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from orchestra.cli.foresight import nodes_ahead
from orchestra.cli.remembered import kept, key
from orchestra.plan.model import Warm
from orchestra.supervise.options import RunOptions
from orchestra.supervise.resolver import document
from orchestra.witness.record import Record
from orchestra.witness.store import Store
from tests.plan.records import plan, process

_NODES = "launch:\n  - node: {pkg: demo, exec: talker}\n"
_NONE = "launch:\n  - executable: {cmd: 'true'}\n"
_WORDS = ["launch", "a.launch.yaml"]


@pytest.fixture(autouse=True)
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a package rclpy on the import path, and nothing remembered."""
    (tmp_path / "rclpy").mkdir()
    monkeypatch.setattr("sys.path", [str(tmp_path)])
    monkeypatch.setenv("ORCHESTRA_CACHE", str(tmp_path / "cache"))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _remember(folder: Path, kept_document: bytes) -> None:
    name = key(_WORDS)
    assert name is not None
    Store(str(folder / "cache/plans")).write(name, Record(), {}, kept_document)
    assert kept(_WORDS) is not None


@pytest.mark.parametrize(("text", "likely"), [(_NODES, True), (_NONE, False), ("- include: {file: b}", True)])
def test_a_launch_file_tells(place: Path, text: str, likely: bool) -> None:
    (place / "a.launch.yaml").write_text(text)
    assert nodes_ahead(_WORDS) is likely
    assert nodes_ahead([*_WORDS, "--no-warm"]) is False


def test_without_rclpy_there_are_none(place: Path) -> None:
    (place / "a.launch.yaml").write_text(_NODES)
    (place / "rclpy").rmdir()
    assert nodes_ahead(_WORDS) is False


@pytest.mark.parametrize(
    ("name", "likely"), [("", True), ("rmw_fastrtps_cpp", True), ("rmw_none_cpp", False)]
)
def test_a_middleware_that_may_be_missing_is_waited_for(
    place: Path, monkeypatch: pytest.MonkeyPatch, name: str, likely: bool
) -> None:
    (place / "a.launch.yaml").write_text(_NODES)
    monkeypatch.setenv("RMW_IMPLEMENTATION", name)
    assert nodes_ahead(_WORDS) is likely


@pytest.mark.parametrize("likely", [True, False])
def test_a_plan_that_is_remembered_tells_more(place: Path, likely: bool) -> None:
    (place / "a.launch.yaml").write_text(_NODES)
    how = Warm(likely, None if likely else "it is not")
    _remember(place, document.dumps(plan(process("a", warm=how)), RunOptions()))
    assert nodes_ahead(_WORDS) is likely


@pytest.mark.skipif(os.geteuid() == 0, reason="everything can be read by root")
def test_one_that_cannot_be_read_tells_nothing(place: Path) -> None:
    (place / "a.launch.yaml").write_text(_NODES)
    _remember(place, b"")
    Path(str(kept(_WORDS))).chmod(0)
    assert nodes_ahead(_WORDS) is True
