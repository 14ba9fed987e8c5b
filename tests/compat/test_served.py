"""What launch files import is served, and forgotten again."""

from __future__ import annotations

import sys
from importlib.machinery import BuiltinImporter, FrozenImporter, PathFinder
from typing import TYPE_CHECKING

import pytest

import orchestra
from orchestra.compat.hook import served

if TYPE_CHECKING:
    from pathlib import Path


def test_packages_without_a_file_are_forgotten_in_any_order(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each of them asks the package around it where it is."""
    innermost = "outermost.a.b.c.d.e.f"
    tmp_path.joinpath(*innermost.split(".")).mkdir(parents=True)
    monkeypatch.syspath_prepend(str(tmp_path))
    with served():
        __import__(innermost)
        assert innermost in sys.modules
    assert not any(name.startswith("outermost") for name in sys.modules)


def test_a_package_whose_outer_one_code_takes_away_is_forgotten_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "outermost" / "inner").mkdir(parents=True)
    monkeypatch.syspath_prepend(str(tmp_path))
    with served():
        __import__("outermost.inner")
        del sys.modules["outermost"]
    assert "outermost.inner" not in sys.modules


@pytest.fixture
def ours(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a module of ours, which one of users is beside, and the import system as it is without pytest."""
    (tmp_path / "ours").mkdir()
    (tmp_path / "users").mkdir()
    (tmp_path / "ours/just_written.py").write_text("from beside_it import VALUE\n")
    (tmp_path / "users/beside_it.py").write_text("VALUE = 3\n")
    monkeypatch.setattr(orchestra, "just_written", None, raising=False)
    monkeypatch.setattr(orchestra, "__path__", [*orchestra.__path__, str(tmp_path / "ours")])
    monkeypatch.syspath_prepend(str(tmp_path / "users"))
    monkeypatch.setattr(sys, "meta_path", [BuiltinImporter, FrozenImporter, PathFinder])
    monkeypatch.setattr(sys, "pycache_prefix", None)
    return tmp_path


def test_code_of_our_modules_is_kept_and_that_of_users_is_not(
    ours: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    with served():
        assert __import__("orchestra.just_written").just_written.VALUE == 3
        assert sys.dont_write_bytecode
    assert not sys.dont_write_bytecode
    assert sys.meta_path == [BuiltinImporter, FrozenImporter, PathFinder]
    (kept,) = ours.rglob("*.pyc")
    assert kept.parent == ours / "ours/__pycache__"


def test_no_code_is_kept_where_nobody_wants_that(ours: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    with served():
        assert __import__("orchestra.just_written").just_written.VALUE == 3
    assert not list(ours.rglob("*.pyc"))
