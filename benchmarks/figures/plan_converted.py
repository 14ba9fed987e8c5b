"""The plan of trees of many forms in XML and in Python, against the same in YAML: seconds on a processor."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from benchmarks import converted_tree, shaped_trees, varied_tree
from benchmarks.figure import Figure, Sample
from benchmarks.figures.plans import SIZES, to_plan

if TYPE_CHECKING:
    from collections.abc import Mapping

    from benchmarks.figure import Site

_MANY_KINDS: Final = "many kinds"
_SHAPES: Final = (
    _MANY_KINDS,
    *(name for name, shape in shaped_trees.SHAPES.items() if shape.python is None),
)
_LANGUAGES: Final = {"xml": "XML", "python": "Python"}


def _name(language: str, shape: str) -> str:
    return f"plan-{language}-{shape.replace(' ', '-')}"


FIGURES: Final = tuple(
    Figure(
        _name(language, shape),
        f"plan of 1,000 nodes in {called}: {shape}",
        "the same nodes in YAML", "ratio", 1.0, "s", 1000, SIZES, 20,
    )
    for language, called in _LANGUAGES.items()
    for shape in _SHAPES
)  # fmt: skip


def measure(site: Site, size: int) -> Mapping[str, Sample]:
    """Measure each with so many nodes."""
    samples = {}
    for shape in _SHAPES:
        if shape == _MANY_KINDS:
            file = varied_tree.write(site.folder, size)
        else:
            file = shaped_trees.write(site.folder, shape, size)
        yaml = to_plan(site, "yaml", file, size)
        for language in _LANGUAGES:
            converted = converted_tree.write(site, file, language)
            end = "py" if language == "python" else language
            samples[_name(language, shape)] = Sample(to_plan(site, end, converted, size), yaml)
    return samples
