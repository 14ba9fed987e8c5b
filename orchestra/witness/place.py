"""Where results are kept."""

from __future__ import annotations

import os

from orchestra.witness.digest import digest_of

TYPE_CHECKING = False  # `typing` costs more than this module, which every start imports
if TYPE_CHECKING:
    from collections.abc import Mapping


def folder(environment: Mapping[str, str]) -> str | None:
    """Return the folder of the user's caches for Orchestra (XDG base directories); None where none can be told."""
    own = environment.get("ORCHESTRA_CACHE")
    if own:
        return own
    shared = environment.get("XDG_CACHE_HOME")
    if not (shared and os.path.isabs(shared)):
        home = os.path.expanduser("~")
        if home == "~":
            return None
        shared = os.path.join(home, ".cache")
    return os.path.join(shared, "orchestra")


def entry(where: str, key: str) -> str:
    """Return the file of the result with this key."""
    return os.path.join(where, digest_of(key.encode("utf-8", "surrogatepass")))
