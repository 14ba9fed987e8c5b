"""The plan of many nodes in trees of one form each: seconds on a processor, by what their files say."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from benchmarks import shaped_trees
from benchmarks.figure import Figure, Sample
from benchmarks.figures.plans import COMPOSE, SIZES, to_compose, to_plan

if TYPE_CHECKING:
    from collections.abc import Mapping

    from benchmarks.figure import Site


def _figure(name: str) -> Figure:
    if shaped_trees.SHAPES[name].python is None:
        title, floor, bar = f"plan of 1,000 nodes in YAML: {name}", COMPOSE, 3.0
    else:
        title, floor, bar = f"plan of 1,000 nodes in Python: {name}", "the same nodes in YAML", 1.0
    return Figure(f"plan-{name.replace(' ', '-')}", title, floor, "ratio", bar, "s", 1000, SIZES, 20)


FIGURES: Final = tuple(_figure(name) for name in shaped_trees.SHAPES)


def measure(site: Site, size: int) -> Mapping[str, Sample]:
    """Measure each with so many nodes."""
    return {
        figure.name: _sample(site, name, size)
        for figure, name in zip(FIGURES, shaped_trees.SHAPES, strict=True)
    }


def _sample(site: Site, name: str, size: int) -> Sample:
    yaml = shaped_trees.write(site.folder, name, size)
    if shaped_trees.SHAPES[name].python is None:
        return Sample(to_plan(site, "yaml", yaml, size), to_compose(site, yaml)[0])
    python = shaped_trees.write(site.folder, name, size, python=True)
    return Sample(to_plan(site, "py", python, size), to_plan(site, "yaml", yaml, size))
