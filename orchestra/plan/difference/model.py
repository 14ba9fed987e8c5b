"""The difference between two plans, as frozen data."""

from __future__ import annotations

from typing import Any, Literal, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.location import Location
from orchestra.plan.model import Via

Side: TypeAlias = Literal["before", "after"]
# `restart` is what a running process cannot take over; a `change` it can.
Fate: TypeAlias = Literal["start", "stop", "restart", "change"]


@dataclass(frozen=True, slots=True)
class Change:
    """One value that differs.

    `field` is the field of the plan (`parameters`, `command`, `ready`, ...), `name` what it is within that, where there
    are several: a parameter, a variable, the name that is remapped, the place of a word. The values are JSON data, None
    where there is none: `absent` tells on which side (a variable that is removed is None too). The places are those of
    the values, `before_through` and `after_through` what they came through.
    """

    field: str
    name: str | None
    before: Any
    after: Any
    before_at: Location | None
    after_at: Location | None
    absent: Side | None = None
    before_through: tuple[Via, ...] = ()
    after_through: tuple[Via, ...] = ()


@dataclass(frozen=True, slots=True)
class Item:
    """What becomes of one process or component, or of a trigger or argument, and the values that make it so.

    A process that starts or stops has no changes. `at` is where it stands in the plan that has it.
    """

    id: str
    kind: Literal["process", "component", "trigger", "argument"]
    fate: Fate
    changes: tuple[Change, ...]
    at: Location


@dataclass(frozen=True, slots=True)
class Difference:
    """All that differs, in plan order; what only the first plan has comes last.

    `arguments` and `triggers` are changes that concern no single process.
    """

    processes: tuple[Item, ...]
    components: tuple[Item, ...]
    triggers: tuple[Item, ...]
    arguments: tuple[Item, ...]

    @property
    def empty(self) -> bool:
        """Whether the two plans do the same."""
        return not (self.processes or self.components or self.triggers or self.arguments)

    def ids(self, *fates: Fate) -> tuple[str, ...]:
        """Return the ids of the processes with one of these fates."""
        return tuple(item.id for item in self.processes if item.fate in fates)
