"""Plans of earlier launches that are still what the same command would come to: neither loaded nor resolved again.

A plan is kept with everything that was looked at on the way to it (`orchestra.witness`), and with the files of the
code that made it. It counts while all of that is as it was, for the same words in the same place. What cannot be
recorded, time, chance, the network, other programs, what code prints, keeps a plan from being kept at all.

This half is imported by the supervisor before anything is started, so it needs the standard library alone.
"""

from __future__ import annotations

import json
import os
import sys
from typing import TYPE_CHECKING, NamedTuple

from orchestra.wheels import as_called
from orchestra.witness.programs import unchanged
from orchestra.witness.standing import standing
from orchestra.witness.store import Store, folder
from orchestra.witness.world import World

if TYPE_CHECKING:
    from collections.abc import Sequence

NO_CACHE = "--no-cache"
_MOST = 32 * 1024 * 1024  # bytes that all plans may take together


class Remembered(NamedTuple):
    """The document of an earlier launch, and what was told on standard error."""

    document: bytes
    told: str


def store() -> Store | None:
    """Return where plans are kept; None where there is no place for them."""
    place = folder(os.environ)
    return None if place is None else Store(os.path.join(place, "plans"), _MOST)  # noqa: PTH118 - pathlib is slow


def key(words: Sequence[str]) -> str | None:
    """Return what tells one launch from another, besides all that may change: its words and where it stands.

    None where that cannot be told: the working folder is gone.
    """
    terminals = [os.isatty(descriptor) for descriptor in (0, 1, 2)]
    try:
        where = [*standing(as_called(os.environ))]
    except OSError:
        return None
    return json.dumps([list(words), terminals, str(sys.flags), *where])


def remembered(words: Sequence[str]) -> Remembered | None:
    """Return what an earlier launch with the same words has come to, if that is still so."""
    kept, name = (None, None) if NO_CACHE in words else (store(), key(words))
    found = None if kept is None or name is None else kept.read(name)
    if found is None:
        return None
    record, result = found
    try:
        known = Remembered(result["document"].encode("utf-8", "surrogatepass"), result["told"])
        still = unchanged(result["code"]) and World(as_called(os.environ), _nobody_asks).holds(record)
    except (KeyError, TypeError, ValueError, AttributeError):
        return None
    return known if still else None


def _nobody_asks(words: str) -> None:
    """Answer nothing: plans are kept by what is looked at alone."""
    del words
