"""An explanation for people: each value, and below it what was written for it, in order."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.plan.render.places import place, value, via_lines
from orchestra.plan.render.setting import plain

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.plan.explained import Explained, Explanation
    from orchestra.plan.model import Candidate
    from orchestra.plan.render.setting import Paint

_TITLES = {"parameter": "parameter ", "remapping": "remapping of ", "environment": "variable "}


def render(explanation: Explanation, paint: Paint = plain) -> str:
    """Return the text; the candidate that counts is marked by an arrow."""
    kind = explanation.kind.replace("_", " ")
    lines = [
        f"{paint('strong', explanation.id)}  {paint('faint', f'({kind}, {place(explanation.location)})')}"
    ]
    for item in explanation.values:
        lines += [f"  {line}" for line in _value(item, paint)]
    if not explanation.values:
        lines.append("  nothing is set that could be explained")
    return "".join(f"{line}\n" for line in lines)


def _value(item: Explained, paint: Paint) -> Iterator[str]:
    came_to = "unset" if item.subject == "environment" and item.value is None else _text(item)
    title = f"{_TITLES.get(item.subject, '')}{item.name}"
    yield f"{paint('strong', title)}: {came_to}{f'  ({item.note})' if item.note else ''}"
    for number, candidate in enumerate(item.candidates, 1):
        yield from (f"  {line}" for line in _candidate(item, candidate, number, paint))


def _text(item: Explained) -> str:
    if item.subject == "parameter" and item.value is None:
        return "no value"
    return str(item.value) if item.subject == "remapping" else value(item.value)


def _candidate(item: Explained, candidate: Candidate, number: int, paint: Paint) -> Iterator[str]:
    mark = "->" if candidate.won else "  "
    if item.subject == "remapping":
        shown = f"{number}. {candidate.value}"
    elif candidate.value is None:
        shown = "no value" if item.subject == "parameter" else "unset"
    else:
        shown = value(candidate.value)
    yield f"{mark} {paint('strong', shown) if candidate.won else shown}"
    yield f"     {candidate.rule}"
    yield f"     {paint('faint', f'at {place(candidate.location)}')}"
    yield from (f"       {line}" for line in via_lines(candidate.through))
