"""What one parameter file sets twice for the same pattern."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.rcl.table import Slots

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.errors import Problems
    from orchestra.resolve.rcl.sections import Entry, Section
    from orchestra.resolve.rcl.table import Slot


def report_duplicates(sections: Sequence[Section], problems: Problems) -> None:
    """Report every parameter that gets a second value for a pattern, and every value that a group displaces."""
    table: dict[str, Slots] = {}
    for section in sections:
        slots = table.setdefault(section.pattern, Slots())
        for entry in section.entries:
            before = next(slots.named(entry.slot), None)
            displaced = before.entry if before is not None and before.name != entry.name else None
            earlier = next((slot.entry for slot in slots.named(entry.name) if slot.entry is not None), None)
            slot = slots.put(entry)
            if displaced is not None:
                _report_displaced(entry, displaced, slot, problems)
            elif earlier is not None and entry.value is not None and earlier.key != entry.key:
                _report_duplicate(section.pattern, entry, earlier, slot, problems)
    if len(table) > 1:
        _report_widened(sections, problems)


def _report_widened(sections: Sequence[Section], problems: Problems) -> None:
    # Here, because few files have several sections.
    from orchestra.resolve.rcl.widened import widened  # noqa: PLC0415

    for entry, earlier, name in widened(sections):
        problems.warning(
            Code.DUPLICATE_PARAMETER,
            f"'{entry.name}' is set for '/{name}' before; this value counts",
            entry.key,
            notes=[f"set first at {earlier.location}"],
        )


def _report_duplicate(pattern: str, entry: Entry, earlier: Entry, slot: Slot, problems: Problems) -> None:
    counts = "this value counts" if slot.entry is entry else f"rcl keeps the one at {earlier.location}"
    problems.warning(
        Code.DUPLICATE_PARAMETER,
        f"'{entry.name}' is set twice for '{pattern}'; {counts}",
        entry.key,
        notes=[f"set first at {earlier.location}"],
    )


def _report_displaced(entry: Entry, displaced: Entry, slot: Slot, problems: Problems) -> None:
    if slot.entry is displaced:
        message = f"rcl gives '{entry.name}' the value of '{displaced.name}' at {displaced.location}"
    else:
        message = f"rcl drops the value of '{displaced.name}' at {displaced.location} for the sake of '{entry.name}'"
    problems.warning(Code.DUPLICATE_PARAMETER, message, entry.key)
