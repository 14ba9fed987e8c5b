"""Whether a name that is nowhere in the plan is a mistake of its own, or only follows from one that is reported."""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING, Final

from orchestra.nearest import is_slip, nearest

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.resolve.model import Resolved

_FAULTY: Final = attrgetter("faulty")


def is_mistake(name: str, known: Iterable[str], resolved: Resolved) -> bool:
    """Return whether a name that is not known is to be reported.

    Where something has been left out for its faults, the name may be of that. It is a mistake all the same if it is a
    slip for a known name.
    """
    if name.rpartition("/")[2] in resolved.lost:
        return False
    if not resolved.incomplete and not any(map(_FAULTY, resolved.processes)):
        return True
    near = nearest(name, known)
    return near is not None and is_slip(name, near)
