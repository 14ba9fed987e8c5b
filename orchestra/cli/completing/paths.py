"""Files and folders as candidates."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.cli.completing.candidates import Candidate

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


def paths(begun: str, wanted: Callable[[Path], bool] = lambda path: path.is_file()) -> Iterator[Candidate]:
    """Yield the folders, and the files that are wanted, that a begun path can become; hidden ones where asked for."""
    written, _, name = begun.rpartition(os.sep)
    folder = os.path.expanduser(written or os.sep if os.sep in begun else ".")  # noqa: PTH111 - no `~x` fails
    before = begun[: len(begun) - len(name)]
    try:
        entries = sorted(Path(folder).iterdir())
    except OSError:
        return
    for entry in entries:
        if not entry.name.startswith(name) or (entry.name.startswith(".") and not name):
            continue
        if entry.is_dir():
            yield Candidate(f"{before}{entry.name}{os.sep}", open=True)
        elif wanted(entry):
            yield Candidate(f"{before}{entry.name}")
