"""Processes that share work out among them."""

from __future__ import annotations

import os
import time
from typing import TYPE_CHECKING

from orchestra.cli.look.pool import Lost, Pool
from orchestra.cli.look.worker import Done

if TYPE_CHECKING:
    from pathlib import Path

_LIMIT = 100.0  # seconds, for a machine that does much else


class _Waiting:
    """Its second piece waits until another process has ended, and takes its own with it."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def foresee(self, piece: int) -> None:
        """Do nothing."""

    def turn(self, piece: int) -> Done:
        limit = time.monotonic() + _LIMIT
        while piece == 1 and time.monotonic() < limit:
            if any(self._folder.iterdir()):
                os._exit(5)
            time.sleep(0.01)
        return Done(piece)

    def end(self) -> None:
        (self._folder / str(os.getpid())).touch()


def test_who_has_nothing_left_ends_at_once_and_another_takes_what_is_given_back(tmp_path: Path) -> None:
    found = dict(Pool(lambda: _Waiting(tmp_path), 2, 2 * _LIMIT).results(8))
    assert found.pop(1) == Lost("has ended the process that was reading it (exit status 5)")
    assert found == {piece: piece for piece in range(8) if piece != 1}
