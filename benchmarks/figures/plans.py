"""The plan of many nodes in files that include each other: seconds on a processor, by language, and as it grows."""

from __future__ import annotations

import resource
from typing import TYPE_CHECKING

from benchmarks import launching, node_tree, varied_tree
from benchmarks.figure import Figure, Sample, Site

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

SIZES = (100, 300, 1000)
COMPOSE = "composing the same bytes with PyYAML's C parser"
_WHOLE = "an interpreter that composes the same bytes so"
_YAML = "the same nodes in YAML"
FIGURES = (
    Figure("plan-yaml", "plan of 1,000 nodes in YAML", COMPOSE, "ratio", 3.0, "s", 1000, SIZES, 20),
    Figure("plan-mixed", "the same, of many kinds", COMPOSE, "ratio", 3.0, "s", 1000, SIZES, 20),
    Figure("plan-xml", "the same in XML", _YAML, "ratio", 1.0, "s", 1000, SIZES, 20),
    Figure("plan-python", "the same in Python", _YAML, "ratio", 1.0, "s", 1000, SIZES, 20),
    Figure("plan-compiled", "the same in Python, planned before", _YAML, "ratio", 1.0, "s", 1000, SIZES, 20),
    Figure(
        "plan-growth", "plan of 10,000 nodes in YAML", "plan of 1,000 nodes",
        "exponent", 1.1, "s", 1000, (100, 300, 1000), 20,
    ),
    Figure(
        "plan-command", "`orchestra plan` of 1,000 nodes in YAML, all of it", _WHOLE,
        "ratio", 3.0, "s", 1000, SIZES, 20,
    ),
    Figure("plan-again", "`orchestra plan` of it again, all of it", COMPOSE, "ratio", 3.0, "s", 1000, SIZES, 20),
    Figure(
        "plan-command-mixed", "`orchestra plan` of many kinds, all of it", _WHOLE,
        "ratio", 3.0, "s", 1000, SIZES, 20,
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
    composed, process = to_compose(site, files["yaml"])
    varied = varied_tree.write(site.folder, size)
    composed_varied, process_varied = to_compose(site, varied)
    # New in a folder that code is imported from, it would be a reason to make the plan again.
    for name in ("cache", "commands"):
        (site.folder / name).mkdir()
    apart = Site(
        site.folder, launching.with_variables(site.environment, ORCHESTRA_CACHE=site.folder / "commands")
    )
    command, again, command_varied = (
        _commanded(apart, file) for file in (files["yaml"], files["yaml"], varied)
    )
    yaml, xml, python = (to_plan(site, language, file, size) for language, file in files.items())
    compiled = to_plan(site, "py", files["py"], size)
    many = to_plan(site, "yaml", node_tree.write(site.folder, "yaml", 10 * size), 10 * size)
    return {
        "plan-yaml": Sample(yaml, composed),
        "plan-mixed": Sample(to_plan(site, "yaml", varied, size), composed_varied),
        "plan-command": Sample(command, process),
        "plan-command-mixed": Sample(command_varied, process_varied),
        "plan-again": Sample(again, composed),
        "plan-xml": Sample(xml, yaml),
        "plan-python": Sample(python, yaml),
        "plan-compiled": Sample(compiled, yaml),
        "plan-growth": Sample(many, yaml),
    }


def to_compose(site: Site, file: Path) -> tuple[float, float]:
    """Return the seconds that it takes to compose the files beside one, and those of the interpreter that does it."""
    seconds = []
    whole = _of_children(lambda: seconds.append(launching.printed(_COMPOSING, [file.parent], site)))
    return seconds[0], whole


def _commanded(site: Site, file: Path) -> float:
    """Return the seconds of a command, from its interpreter's start to its end."""

    def planned() -> None:
        with launching.started(launching.orchestra("plan", file), site) as popen:
            launching.finished(popen)

    return _of_children(planned)


def _of_children(call: Callable[[], None]) -> float:
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    call()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def to_plan(site: Site, language: str, file: Path, size: int) -> float:
    """Return the seconds that the plan of a file takes, which has so many nodes."""
    folder = site.folder / "one"
    folder.mkdir(exist_ok=True)
    one = folder / f"{language}1" / f"part1_0.launch.{language}"
    return launching.printed(
        _PLAN, [file, str(size), one if one.exists() else node_tree.write(folder, language, 1)], site
    )
