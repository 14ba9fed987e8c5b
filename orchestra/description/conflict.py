"""Why keys that are sound each for itself cannot stand in one entity."""

from __future__ import annotations

from typing import NamedTuple


class Conflict(NamedTuple):
    """The reason, in the user's words, and the keys that are too many, of which the last one written is told.

    Without keys something is missing: that is told of the entity as a whole.
    """

    reason: str
    keys: tuple[str, ...] = ()
