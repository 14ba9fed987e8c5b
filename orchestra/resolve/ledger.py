"""What is done with variables, and what conditions left out: kept per file, for whoever judges its arguments."""

from __future__ import annotations

from orchestra.dataclass import dataclass
from orchestra.description.entity import Conditional
from orchestra.fields import field
from orchestra.location import Location


@dataclass(frozen=True, slots=True)
class Hidden:
    """An action that its condition left out, and the files that includes in it name: None for one that is not known."""

    action: Conditional
    files: tuple[str | None, ...]


@dataclass(slots=True)
class Ledger:
    """What a file and the files it includes do with variables.

    `defaulted` are the declared ones left at their default, `missing` those that have neither default nor value,
    with the place of the declaration. `hidden` are the actions that conditions left out; `incomplete` tells that a
    file could not be read or found, so that there may be more.
    """

    read: set[str] = field(default_factory=set)
    declared: set[str] = field(default_factory=set)
    defaulted: set[str] = field(default_factory=set)
    missing: dict[str, Location] = field(default_factory=dict)
    hidden: list[Hidden] = field(default_factory=list)
    incomplete: bool = False

    def absorb(self, other: Ledger) -> None:
        """Take over what an include did; what it lacks is settled where it ends."""
        self.read |= other.read
        self.declared |= other.declared
        self.defaulted |= other.defaulted
        self.hidden += other.hidden
        self.incomplete |= other.incomplete
