"""Outcomes as a table for people, and as JSON."""

from __future__ import annotations

import os
import platform
import time
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from benchmarks.figure import Figure, Outcome

_HEAD = ("figure", "ours", "floor", "is", "of the floor", "bar", "met", "ROS 2 launch")


def table(outcomes: Sequence[Outcome]) -> str:
    """Return the table, in Markdown, aligned; only the sizes that a bar is about, where there are any."""
    held = [outcome for outcome in outcomes if outcome.met is not None] or list(outcomes)
    rows = [_HEAD, *map(_row, held)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [" | ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in rows]
    rule = "-|-".join("-" * width for width in widths)
    return "\n".join(f"| {line} |" for line in (lines[0], rule, *lines[1:])).replace(
        f"| {rule} |", f"|-{rule}-|"
    )


def document(outcomes: Iterable[Outcome], unable: Iterable[tuple[Figure, str]]) -> dict[str, Any]:
    """Return everything that was measured as JSON data."""
    return {
        "time": time.time(),
        "machine": {"processors": os.cpu_count(), "system": platform.system(), "machine": platform.machine()},
        "python": platform.python_version(),
        "figures": [
            {
                **asdict(outcome.figure),
                "size": outcome.size,
                "ours": outcome.ours,
                "floor": outcome.floor,
                "peer": outcome.peer,
                "comes_to": outcome.comes_to,
                "peer_comes_to": outcome.peer_comes_to,
                "met": outcome.met,
                "samples": [asdict(sample) for sample in outcome.samples],
            }
            for outcome in outcomes
        ],
        "unable": [{"name": figure.name, "reason": reason} for figure, reason in unable],
    }


def line(outcome: Outcome) -> str:
    """Return what came of one figure at one size, in a line."""
    cells = _row(outcome)
    return f"{outcome.figure.name} ({outcome.size}): {cells[1]} ours, {cells[2]} floor, {cells[4]}; bar {cells[5]}"


def _row(outcome: Outcome) -> tuple[str, ...]:
    figure = outcome.figure
    met = {True: "yes", False: "NO", None: ""}[outcome.met]
    return (
        figure.title,
        _amount(outcome.ours, figure.unit),
        _amount(outcome.floor, figure.unit),
        figure.floor,
        _standing(figure, outcome.comes_to),
        f"≤ {_standing(figure, figure.bar)}",
        met,
        _standing(figure, outcome.peer_comes_to),
    )


def _amount(value: float | None, unit: str) -> str:
    return "" if value is None else f"{value:.3g} {unit}" if value < 1000 else f"{value:.0f} {unit}"  # noqa: PLR2004


def _standing(figure: Figure, value: float | None) -> str:
    if value is None:
        return ""
    number = f"{value:.2f}".rstrip("0").rstrip(".")
    if figure.way == "ratio":
        return f"{number} ×"
    if figure.way == "difference":
        return f"{number} {figure.unit} more"
    return f"exponent {number}" if figure.way == "exponent" else f"{number} {figure.unit}"
