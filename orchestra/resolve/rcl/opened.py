"""What the reader of parameter files has open at a time."""

from __future__ import annotations

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.location import Location
from orchestra.pyyaml import yaml
from orchestra.resolve.rcl.sections import Entry
from orchestra.values import Scalar


class Unreadable(Exception):  # noqa: N818 - no fault of the program
    """What follows cannot be made sense of; why has been reported."""


@dataclass(slots=True)
class OpenParameter:
    """The key that was read last: rcl's name for it, and the name under which it looks for its slot."""

    name: str
    slot: str
    key: Location


@dataclass(slots=True)
class OpenSection:
    """A section that is being read; one with a faulty pattern is left out."""

    pattern: str
    location: Location
    sound: bool
    entries: list[Entry] = field(default_factory=list)


@dataclass(slots=True)
class OpenList:
    """A list that is being read so deep; `items` is None once an inner list has ended. `written` are their events.

    `inner` is the place of the first list inside it, `mapping` that of the first mapping.
    """

    start: yaml.Event
    depth: int
    items: list[Scalar] | None = field(default_factory=list)
    written: list[yaml.Event] = field(default_factory=list)
    sound: bool = True
    inner: Location | None = None
    mapping: Location | None = None

    def take(self, item: Scalar, event: yaml.ScalarEvent) -> None:
        """Take an item; behind an inner list they begin anew."""
        self.items = [] if self.items is None else self.items
        self.items.append(item)
        self.written.append(event)
