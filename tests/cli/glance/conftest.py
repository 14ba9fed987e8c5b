"""A glance at a text, as if it were a file in a place with one package."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import pytest

from orchestra.cli.glance.model import Places
from orchestra.cli.glance.walk import glance

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.cli.glance.model import Glance


class Look(Protocol):
    """Writes a text to a file and glances at it."""

    def __call__(self, name: str, text: str) -> Glance:
        """Return what is seen."""


@pytest.fixture
def look(tmp_path: Path) -> Look:
    """Glance at files in `tmp_path`; the package `demo` has the share `/s` and the prefix `/p`."""

    def share(package: str) -> str | None:
        return "/s" if package == "demo" else None

    def prefix(package: str) -> str | None:
        return "/p" if package == "demo" else None

    def looked(name: str, text: str) -> Glance:
        (tmp_path / name).write_text(text)
        return glance(Places(str(tmp_path / name), share, prefix))

    return looked
