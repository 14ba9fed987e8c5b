"""Variables that a new scope begins with (`keep`)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.resolve.context import Value
from orchestra.resolve.scope import Scope

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.parts import Pair
    from orchestra.location import Location
    from orchestra.resolve.context import Evaluated
    from orchestra.resolve.resolution import Resolution


@dataclass(slots=True)
class Apart(Scope):
    """A scope that sees no more of the variables `outside` than it keeps."""

    outside: tuple[str, ...] = ()


def kept(pairs: Sequence[Pair], run: Resolution) -> list[tuple[str, Evaluated, Location]]:
    """Return the variables, which are evaluated in the scope outside."""
    found = []
    for pair in pairs:
        name, value = run.evaluate(pair.name), run.evaluate(pair.value)
        if isinstance(name, Value) and value is not None:
            found.append((name.text, value, run.at(pair.value.span)))
    return found
