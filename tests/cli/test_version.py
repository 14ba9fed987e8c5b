"""The version is that of the metadata, and is told without what reads metadata."""

from __future__ import annotations

import subprocess
import sys
from importlib import metadata
from typing import TYPE_CHECKING

from orchestra.cli.version import version

if TYPE_CHECKING:
    from pathlib import Path

    import pytest


def test_it_is_that_of_the_metadata() -> None:
    assert version() == metadata.version("orchestra")


def test_the_first_on_the_path_counts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "orchestra-7.1.dev0+local.dist-info").mkdir()
    (tmp_path / "orchestra_more-9.dist-info").mkdir()
    monkeypatch.setattr(sys, "path", [str(tmp_path / "none.zip"), str(tmp_path), *sys.path])
    assert version() == "7.1.dev0+local"


def test_where_it_is_told_otherwise_the_library_is_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "path", [])
    monkeypatch.setattr(metadata, "version", lambda name: f"{name} of another kind")
    assert version() == "orchestra of another kind"


def test_metadata_are_not_imported_for_it() -> None:
    program = (
        "import sys; from orchestra.cli.main import main; main(['--version']);"
        " print('importlib.metadata' in sys.modules)"
    )
    words = [sys.executable, "-P", "-c", program]
    done = subprocess.run(words, check=True, capture_output=True, text=True, timeout=60)
    assert done.stdout.splitlines()[1:] == ["False"]
