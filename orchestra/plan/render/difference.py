"""A difference between two plans for people: what becomes of each process, and value by value why."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.plan.render.places import place, value, via_lines
from orchestra.plan.render.setting import plain

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.location import Location
    from orchestra.plan.difference.model import Change, Difference, Item
    from orchestra.plan.model import Via
    from orchestra.plan.render.setting import Paint

# What is said of each kind of thing for each of its fates, and in which style.
_FATES: Final = {
    "process": {
        "start": "starts",
        "stop": "stops",
        "restart": "restarts",
        "change": "changes without a restart",
    },
    "component": {
        "start": "is loaded",
        "stop": "is unloaded",
        "restart": "is loaded anew",
        "change": "changes where it is",
    },
    "trigger": {"start": "is new", "stop": "is gone", "restart": "", "change": ""},
    "argument": {"start": "is new", "stop": "is gone", "restart": "", "change": "has changed"},
}
_SIGNS: Final = {"start": "+", "stop": "-", "restart": "!", "change": "~"}
_STYLES: Final = {"+": "help", "-": "error", "!": "warning", "~": "faint"}


def render(difference: Difference, before: str, after: str, paint: Paint = plain) -> str:
    """Return the text; `before` and `after` say what the two plans are of."""
    heading = f"from {before}\nto   {after}\n"
    if difference.empty:
        return f"{heading}\nno difference\n"
    parts = (difference.arguments, difference.processes, difference.components, difference.triggers)
    sections = ["".join(_item(item, paint) for item in items) for items in parts if items]
    return "\n".join([heading, *sections, f"{_summary(difference)}\n"])


def _summary(difference: Difference) -> str:
    counts = (
        (len(difference.ids("start")), "to start"),
        (len(difference.ids("stop")), "to stop"),
        (len(difference.ids("restart")), "to restart"),
        (len(difference.ids("change")), "changed without a restart"),
    )
    said = [f"{number} {words}" for number, words in counts if number]
    return f"processes: {', '.join(said) or 'all stay as they are'}"


def _item(item: Item, paint: Paint) -> str:
    sign, told = _SIGNS[item.fate], _FATES[item.kind][item.fate]
    name = item.id if item.kind == "process" else f"{item.kind} {item.id}"
    lines = [
        f"{paint(_STYLES[sign], sign)} {paint('strong', name)} {told}  {paint('faint', f'({place(item.at)})')}"
    ]
    for change in item.changes:
        lines += [f"    {line}" for line in _change(change, item, paint)]
    return "".join(f"{line}\n" for line in lines)


def _change(change: Change, item: Item, paint: Paint) -> Iterator[str]:
    name = change.field if change.name is None else f"{change.field} {change.name}"
    yield f"{name}:"
    sides = (
        ("-", "before", change.before, change.before_at, change.before_through),
        ("+", "after", change.after, change.after_at, change.after_through),
    )
    for sign, side, data, location, through in sides:
        if change.absent != side:
            unset = change.field == "environment" and data is None
            text = "unset" if unset else _shown(change, data)
            yield f"  {paint(_STYLES[sign], sign)} {text}{paint('faint', _at(location, item))}"
            yield from (f"      {line}" for line in via_lines(_told(through, change, side)))


def _told(through: Sequence[Via], change: Change, side: str) -> Sequence[Via]:
    """Return what a value came through; where both sides came the same way, it is told once."""
    return () if side == "before" and change.before_through == change.after_through else through


def _shown(change: Change, data: object) -> str:
    if change.field in ("command", "parameter_files") and isinstance(data, list):
        return " ".join(map(value, data)) if change.field == "command" else value(data)
    return value(data)


def _at(location: Location | None, item: Item) -> str:
    """Return where a value stands, unless that is where the whole process does, which has been said."""
    return "" if location is None or location == item.at else f"  ({place(location)})"
