"""Which value of a parameter counts in a node.

rcl merges everything on the command line into one table by pattern. A node applies the patterns that match it in the
order in which each appeared first, a later pattern over an earlier one; within one pattern the last value counts.
Measured: `tests/data/rcl-probes.jsonl`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.resolve.rcl.patterns import matches
from orchestra.resolve.rcl.sections import Entry, Section
from orchestra.resolve.rcl.table import flat, kind_of, tabulated
from orchestra.values import ParameterValue

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from orchestra.location import Location


@dataclass(frozen=True, slots=True)
class Written:
    """A value that somebody wrote for a parameter of the node; `won` marks the one that counts."""

    pattern: str
    entry: Entry
    won: bool

    @property
    def value(self) -> ParameterValue | None:
        """What was written."""
        return self.entry.value

    @property
    def location(self) -> Location:
        """Where it was written."""
        return self.entry.location


@dataclass(frozen=True, slots=True)
class Setting:
    """A parameter of a node: its value, all that was written for it in order, and why this value counts.

    `value` is None where rcl hands the node a parameter without a type (an empty list or mapping), which makes it
    fail. `overruled` is the value that plain "last wins" would have chosen, where that is another one.
    """

    name: str
    value: ParameterValue | None
    written: tuple[Written, ...]
    rule: str
    overruled: Written | None


def effective(sections: Iterable[Section], full_name: str) -> dict[str, Setting]:
    """Return the parameters of the node by name, given all sections in the order of its command line."""
    return settled([section for section in sections if matches(section.pattern, full_name)])


def settled(matching: Sequence[Section]) -> dict[str, Setting]:
    """Return the same of sections all of which are for the node."""
    winners: dict[str, tuple[str, Entry | None]] = {}
    plain = flat(matching)
    if plain is not None:
        for pattern, entries in plain.items():
            for name, entry in entries.items():
                winners[name] = (pattern, entry)
    else:
        for pattern, slots in tabulated(matching).items():
            for slot in slots:
                winners[slot.name] = (pattern, slot.entry)
    written: dict[str, list[tuple[str, Entry]]] = {name: [] for name in winners}
    for section in matching:
        for entry in section.entries:
            if entry.name in written and not entry.opens:
                written[entry.name].append((section.pattern, entry))
    return {name: _setting(name, *winners[name], written[name]) for name in winners}


def _setting(name: str, pattern: str, winner: Entry | None, written: list[tuple[str, Entry]]) -> Setting:
    if len(written) == 1 and written[0][1] is winner:  # as nearly always
        where, entry = written[0]
        only = (Written(where, entry, True),)
        return Setting(name, entry.value, only, _rule(pattern, winner, only), None)
    if winner is not None and all(entry is not winner for _, entry in written):
        written = [
            (pattern, winner),
            *written,
        ]  # it was written for the group whose slot this parameter took over
    candidates = tuple(Written(where, entry, entry is winner) for where, entry in written)
    last = candidates[-1] if candidates else None
    overruled = last is not None and winner is not None and repr(last.value) != repr(winner.value)
    return Setting(
        name,
        None if winner is None else winner.value,
        candidates,
        _rule(pattern, winner, candidates),
        last if overruled else None,
    )


def _rule(pattern: str, winner: Entry | None, candidates: tuple[Written, ...]) -> str:
    """Return why the winner counts, as half a sentence."""
    if winner is None or winner.value is None:
        return f"'{pattern}' gives it no value"
    if len(candidates) == 1:
        return f"set for '{pattern}'"
    others = list(
        dict.fromkeys(candidate.pattern for candidate in candidates if candidate.pattern != pattern)
    )
    if others:
        return (
            f"'{pattern}' is the matching pattern that appears last for the first time, after '{others[-1]}'"
        )
    if candidates[-1].won:
        return f"the last value for '{pattern}'"
    return f"of values of several types for '{pattern}', rcl takes the {kind_of(winner.value)}"
