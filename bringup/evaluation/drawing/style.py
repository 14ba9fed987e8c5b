"""What all pictures have in common: colours, and how a figure becomes files."""

from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib as mpl
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

if TYPE_CHECKING:
    from contextlib import AbstractContextManager
    from pathlib import Path

COLOURS = ("#1f6fd0", "#d1432f", "#2a9148", "#8453b8", "#c98500", "#0c8f9c")
WALL, OBSTACLE, BAND, INK = "#4a4e57", "#c8ab8b", "#dfe7f1", "#24292f"
# Text stays text and needs the reader's own font; the same run gives the same bytes.
STYLE = {
    "svg.fonttype": "none",
    "svg.hashsalt": "bringup",
    "font.family": "sans-serif",
    "font.size": 9.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": INK,
    "lines.linewidth": 1.2,
    "path.simplify_threshold": 0.7,
    "legend.frameon": False,
}
DOTS_PER_INCH = 100


def figure(width: float, height: float) -> Figure:
    """A new figure of a size in inches. It belongs to nobody else: no global state of pyplot is used."""
    return Figure(figsize=(width, height), layout="constrained")


def colour(number: int) -> str:
    """The colour of a robot."""
    return COLOURS[number % len(COLOURS)]


def save(drawn: Figure, folder: Path, name: str) -> list[Path]:
    """Write a figure as NAME.svg and NAME.png. Raises OSError."""
    vector, raster = folder / f"{name}.svg", folder / f"{name}.png"
    FigureCanvasSVG(drawn).print_svg(vector, metadata={"Date": None, "Creator": None})
    # Everything has its place by now; finding it takes longer than drawing.
    drawn.set_layout_engine("none")
    FigureCanvasAgg(drawn).print_png(raster, metadata={"Software": None})
    return [vector, raster]


def styled() -> AbstractContextManager[None]:
    """The settings in force while figures are made and saved, in a `with` block."""
    context: AbstractContextManager[None] = mpl.rc_context(
        {**STYLE, "savefig.dpi": DOTS_PER_INCH, "figure.dpi": DOTS_PER_INCH}
    )
    return context
