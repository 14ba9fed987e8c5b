"""The plan of many nodes in files that include each other: seconds on a processor, by language, and as it grows."""

from __future__ import annotations

import resource
from typing import TYPE_CHECKING

from benchmarks import launching, node_tree, varied_tree
from benchmarks.figure import Figure, Sample

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from benchmarks.figure import Site

_SIZES = (100, 300, 1000)
_COMPOSE = "composing the same bytes with PyYAML's C parser"
_YAML = "the same nodes in YAML"
FIGURES = (
    Figure("plan-yaml", "plan of 1,000 nodes in YAML", _COMPOSE, "ratio", 3.0, "s", 1000, _SIZES, 20),
    Figure("plan-mixed", "the same, of many kinds", _COMPOSE, "ratio", 3.0, "s", 1000, _SIZES, 20),
    Figure("plan-again", "`orchestra plan` of it again, all of it", _COMPOSE, "ratio", 3.0, "s", 1000, _SIZES, 20),
    Figure("plan-xml", "the same in XML", _YAML, "ratio", 1.0, "s", 1000, _SIZES, 20),
    Figure("plan-python", "the same in Python", _YAML, "ratio", 1.0, "s", 1000, _SIZES, 20),
    Figure("plan-compiled", "the same in Python, planned before", _YAML, "ratio", 1.0, "s", 1000, _SIZES, 20),
    Figure(
        "plan-growth", "plan of 10,000 nodes in YAML", "plan of 1,000 nodes",
        "exponent", 1.1, "s", 1000, (100, 300, 1000), 20,
    ),
)  # fmt: skip

# What is imported for the first node is not counted: a plan of one is made before.
_PLAN = """
import os, sys, time
from orchestra import pipeline
from orchestra.errors import Problems
inputs = pipeline.inputs_from((), environment=os.environ)
pipeline.collect(sys.argv[3], inputs, Problems())
problems = Problems()
began = time.process_time()
plan = pipeline.collect(sys.argv[1], inputs, problems)
seconds = time.process_time() - began
assert not list(problems), list(problems)[0]
assert len(plan.processes) == int(sys.argv[2]), len(plan.processes)
print(seconds)
"""
_COMPOSING = """
import sys, time, yaml
from pathlib import Path
texts = [path.read_bytes() for path in Path(sys.argv[1]).iterdir()]
began = time.process_time()
for text in texts:
    yaml.compose(text, Loader=yaml.CSafeLoader)
print(time.process_time() - began)
"""


def measure(site: Site, size: int) -> Mapping[str, Sample]:
    """Measure it with so many nodes, and with ten times as many."""
    files = {language: node_tree.write(site.folder, language, size) for language in ("yaml", "xml", "py")}
    composed = launching.printed(_COMPOSING, [files["yaml"].parent], site)
    varied = varied_tree.write(site.folder, size)
    composed_varied = launching.printed(_COMPOSING, [varied.parent], site)
    # New in a folder that code is imported from, it would be a reason to make the plan again.
    (site.folder / "cache").mkdir()
    yaml, xml, python = (_planned(site, language, file, size) for language, file in files.items())
    compiled = _planned(site, "py", files["py"], size)
    many = _planned(site, "yaml", node_tree.write(site.folder, "yaml", 10 * size), 10 * size)
    return {
        "plan-yaml": Sample(yaml, composed),
        "plan-mixed": Sample(_planned(site, "yaml", varied, size), composed_varied),
        "plan-again": Sample(_again(site, files["yaml"]), composed),
        "plan-xml": Sample(xml, yaml),
        "plan-python": Sample(python, yaml),
        "plan-compiled": Sample(compiled, yaml),
        "plan-growth": Sample(many, yaml),
    }


def _again(site: Site, file: Path) -> float:
    """Return the seconds that a command took which another one with the same words came before."""
    _planning(site, file)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    _planning(site, file)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _planning(site: Site, file: Path) -> None:
    with launching.started(launching.orchestra("plan", file), site) as popen:
        launching.finished(popen)


def _planned(site: Site, language: str, file: Path, size: int) -> float:
    folder = site.folder / "one"
    folder.mkdir(exist_ok=True)
    one = folder / f"{language}1" / f"part1_0.launch.{language}"
    return launching.printed(
        _PLAN, [file, str(size), one if one.exists() else node_tree.write(folder, language, 1)], site
    )
