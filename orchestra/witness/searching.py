"""Searches for modules, of which the import system tells nobody."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra.witness.observing import observer

if TYPE_CHECKING:
    from collections.abc import Iterable


def searched(folders: Iterable[str], found: Iterable[str] | None) -> None:
    """Record that a module is searched for in folders, and in which it is found."""
    watching = observer()
    if not watching.active:
        return
    for folder in (*folders, *(found or ())):
        watching.listed(folder or ".")
        if os.path.isfile(folder):
            watching.unknown(f"{folder} holds modules")
