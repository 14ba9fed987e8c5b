"""Names joined from nested keys the way rcl joins them: one text that grows and shrinks, and a count."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from collections.abc import Iterable


@dataclass(slots=True)
class Joined:
    """A name joined with a separator.

    `shrink` cuts behind the last separator, not behind what was added last: a key that holds the separator itself
    leaves its first part behind. That is rcl's `rem_name_from_ns`, and files are read by it.
    """

    separator: str
    text: str = ""
    count: int = 0

    def grow(self, name: str) -> None:
        """Add a name, one level deeper."""
        self.text = joined(self.separator, [self.text, name]) if self.count else name
        self.count += 1

    def replace(self, text: str) -> None:
        """Put a whole text in place, one level deeper."""
        self.text = text
        self.count += 1

    def shrink(self) -> None:
        """Leave one level."""
        if self.count <= 1:
            self.text = ""
        elif self.separator in self.text:
            self.text = self.text.rpartition(self.separator)[0]
        self.count = max(0, self.count - 1)


def joined(separator: str, names: Iterable[str]) -> str:
    """Return names joined; one that ends with the separator gets no second one."""
    first, *rest = [*names] or [""]
    return reduce(lambda text, name: f"{text.removesuffix(separator)}{separator}{name}", rest, first)
