"""What files leave in memory is let go of while others are looked at."""

from __future__ import annotations

import gc
import sys
import weakref
from typing import TYPE_CHECKING

import pytest

from orchestra.cli.look import sharing
from orchestra.cli.look.garbage import Garbage
from orchestra.cli.look.sharing import SharedLoader
from orchestra.errors import Problems

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


class _Circle:
    def __init__(self) -> None:
        self.own = self


@pytest.fixture
def _no_collector() -> Iterator[None]:
    before = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if before:
            gc.enable()


@pytest.mark.usefixtures("_no_collector")
def test_what_code_leaves_in_circles_is_collected_after_some_files() -> None:
    left = weakref.ref(_Circle())
    garbage = Garbage()
    for _ in range(100):
        garbage.left_by(code=False)
    assert left() is not None
    for _ in range(16):
        garbage.left_by(code=True)
    assert left() is None


def test_descriptions_are_kept_that_were_used_last(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sharing, "_MOST", 2)
    loader = SharedLoader(lambda _: set())
    for name in "abc":
        (tmp_path / f"{name}.launch.yaml").write_text(f"launch: [log: {{message: {name}}}]\n")

    def load(name: str) -> object:
        return loader.load(str(tmp_path / f"{name}.launch.yaml"), Problems())

    first, second = load("a"), load("b")
    assert load("a") is first
    load("c")
    assert load("a") is first
    assert load("b") is not second
    assert load("b") == second


@pytest.mark.usefixtures("_no_collector")
def test_what_has_been_imported_is_not_walked_through(monkeypatch: pytest.MonkeyPatch) -> None:
    garbage, frozen = Garbage(), gc.get_freeze_count()
    try:
        garbage.left_by(code=True)
        assert gc.get_freeze_count() == frozen
        monkeypatch.setitem(sys.modules, "one_more", sys)
        kept = [[number] for number in range(1000)]
        garbage.left_by(code=True)
        assert gc.get_freeze_count() >= frozen + len(kept)
    finally:
        gc.unfreeze()
