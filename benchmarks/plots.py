"""A plot for each figure over the size, with matplotlib, which only this module imports."""

from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib as mpl

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from benchmarks.figure import Outcome


def plot(outcomes: Sequence[Outcome], folder: Path) -> Path:
    """Draw one figure, measured at several sizes; return the file."""
    mpl.use("svg")
    from matplotlib import pyplot as plt  # noqa: PLC0415 - the way of drawing must be chosen before

    figure = outcomes[0].figure
    canvas, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    sizes = [outcome.size for outcome in outcomes]
    lines = (
        ("Orchestra", [outcome.ours for outcome in outcomes]),
        (figure.floor, [outcome.floor for outcome in outcomes]),
        ("ROS 2 launch", [outcome.peer for outcome in outcomes]),
    )
    for label, values in lines:
        if all(value is not None for value in values):
            axes.plot(sizes, values, marker="o", label=label)
    axes.set(title=figure.title, xlabel="size", ylabel=figure.unit, xlim=(0, None), ylim=(0, None))
    axes.legend()
    path = folder / f"{figure.name}.svg"
    canvas.savefig(path)
    plt.close(canvas)
    return path
