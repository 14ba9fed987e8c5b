"""Plans of earlier launches that are still what the same command would come to: neither loaded nor resolved again.

A plan is kept with everything that was looked at on the way to it (`orchestra.witness`), and with the files of the
code that made it. It counts while all of that is as it was, for the same words in the same place. What cannot be
recorded, time, chance, the network, other programs, what code prints, keeps a plan from being kept at all.

This half is imported before it is known whether something is kept: by what it needs to find that nothing is, it holds
up every first launch.
"""

from __future__ import annotations

import os
import sys

from orchestra.wheels import as_called
from orchestra.witness.place import entry, folder
from orchestra.witness.standing import standing

TYPE_CHECKING = False  # `typing` costs more than this module
if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.cli.recollection import Remembered

NO_CACHE = "--no-cache"


def place() -> str | None:
    """Return the folder in which plans are kept; None where there is no place for them."""
    where = folder(os.environ)
    return None if where is None else os.path.join(where, "plans")  # noqa: PTH118 - pathlib is slow


def key(words: Sequence[str]) -> str | None:
    """Return what tells one launch from another, besides all that may change: its words and where it stands.

    None where nobody wants a plan to be kept, and where it cannot be told: the working folder is gone.
    """
    if NO_CACHE in words:
        return None
    terminals = [os.isatty(descriptor) for descriptor in (0, 1, 2)]
    try:
        return repr((list(words), terminals, sys.flags, *standing(as_called(os.environ))))
    except OSError:
        return None


def kept(words: Sequence[str]) -> str | None:
    """Return the file with what an earlier launch with the same words has come to, None where there is none."""
    sought = _sought(words)
    return None if sought is None else entry(*sought)


def remembered(words: Sequence[str]) -> Remembered | None:
    """Return what an earlier launch with the same words has come to, if that is still so."""
    sought = _sought(words)
    if sought is None:
        return None
    from orchestra.cli.recollection import recollection  # noqa: PLC0415 - of no use where nothing is kept

    return recollection(*sought)


def _sought(words: Sequence[str]) -> tuple[str, str] | None:
    """Return folder and key of what is kept of an earlier launch; None where there is nothing."""
    where, name = place(), key(words)
    if where is None or name is None or not os.path.exists(entry(where, name)):  # noqa: PTH110 - as above
        return None
    return where, name
