"""What launch files import is served, and forgotten again."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from orchestra.compat.hook import served

if TYPE_CHECKING:
    from pathlib import Path

    import pytest


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
