"""Why keys that are sound each for itself cannot stand in one entity."""

from __future__ import annotations

from orchestra.dataclass import dataclass


@dataclass(frozen=True, slots=True)
class Conflict:
    """The reason, in the user's words, and the keys that are too many, of which the last one written is told.

    Without keys something is missing: that is told of the entity as a whole.
    """

    reason: str
    keys: tuple[str, ...] = ()
