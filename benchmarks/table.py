"""Which module measures which figures; imported when they are wanted."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Final, cast

if TYPE_CHECKING:
    from collections.abc import Iterator

    from benchmarks.figure import Measurement

# In the order of the table that is printed.
MEASUREMENTS: Final = (
    "first_process",
    "python_node",
    "twenty_nodes",
    "restarted_node",
    "plans",
    "plan_shapes",
    "plan_converted",
    "short_processes",
    "up_and_down",
    "output",
    "watching",
    "restarts",
    "checked_tree",
    "graph_questions",
    "simulation",
)


def measurements() -> Iterator[Measurement]:
    """Yield all of them."""
    for name in MEASUREMENTS:
        yield cast("Measurement", import_module(f"benchmarks.figures.{name}"))
