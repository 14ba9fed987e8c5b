"""An item of a list that is two, for a '- ' too many: one has the first key of a pair, the next one the other."""

from __future__ import annotations

from typing import Final

from orchestra.dataclass import dataclass
from orchestra.description.source import Keyed
from orchestra.errors import Code, Problem, Problems

_FIRST: Final = {"value": "name", "to": "from"}


@dataclass(slots=True)
class Halves:
    """What has been told last of an item that has the first key of a pair alone."""

    problems: Problems
    item: Keyed | None = None

    def told(self, item: Keyed) -> None:
        """Note that it has been told what an item lacks."""
        self.item = item if type(item) is Keyed and len(item) == 1 else None

    def joined(self, item: Keyed) -> bool:
        """Tell of an item that is the other half of the one before it, in place of what that one lacks."""
        if self.item is None or type(item) is not Keyed or len(item) != 1:
            return False
        (key,), (first,) = item, self.item
        at, before, end = item.keys_at[key], self.item.keys_at[first], getattr(self.item[first], "span", None)
        adjoining = end is not None and at.line == end.end_line + 1 and at.column == before.column
        if _FIRST.get(key) != first or not adjoining:
            return False
        lacked = self.problems.last
        if lacked is None or lacked.span != before:
            return False
        told = f"`{key}` belongs to the item before: the '- ' that makes it one of its own is too many"
        self.problems.withdraw(lacked)
        self.problems.report(
            Problem(Code.MISSING_KEY, lacked.severity, told, at, lacked.included_from, None, ())
        )
        self.item = None
        return True
