"""The folder for temporary files of a check."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.cli.look.scratch import scratch

if TYPE_CHECKING:
    import pytest


def test_it_goes_away_with_all_that_is_in_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    with scratch() as folder:
        assert [*tmp_path.iterdir()] == [Path(folder)]
        assert Path(folder).stat().st_mode & 0o777 == 0o700
    assert not [*tmp_path.iterdir()]
    with scratch() as folder:
        left = Path(folder, "left", "by")
        left.joinpath("code").mkdir(parents=True)
        left.chmod(0)
        Path(folder).chmod(0)
    assert not [*tmp_path.iterdir()]


def test_code_may_have_removed_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    with scratch() as folder:
        Path(folder).rmdir()
    assert not [*tmp_path.iterdir()]


def test_it_is_made_elsewhere_where_the_usual_place_is_none(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("TMPDIR", str(tmp_path / "nowhere"))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    with scratch() as folder:
        assert Path(folder).parent == tmp_path.resolve()
    assert not [*tmp_path.iterdir()]
