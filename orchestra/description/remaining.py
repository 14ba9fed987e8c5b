"""What is left of a mapping whose faulty parts have been reported."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Sequence
    from collections.abc import Set as AbstractSet

    from pydantic_core import ErrorDetails

    from orchestra.description.source import Keyed

# Lists whose items say nothing about each other: a wrong one hides no other.
_INDEPENDENT: Final = frozenset({"composable_node", "env", "param", "remap"})


def sound_values(mapping: Keyed, wrong: AbstractSet[str], details: Sequence[ErrorDetails]) -> dict[str, Any]:
    """Return the values of a mapping without those that are wrong; of some lists only the wrong items are left out."""
    values = {key: value for key, value in mapping.items() if key not in wrong}
    for key in wrong & _INDEPENDENT & mapping.keys():
        ways = {error["loc"][1:2] for error in details if error["loc"][:1] == (key,)}
        items = mapping[key]
        if isinstance(items, list) and all(ways):
            values[key] = [item for at, item in enumerate(items) if (at,) not in ways]
    return values
