from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Problem, Problems
from orchestra.load.grammar import parse_template
from orchestra.location import Location, Span, point
from orchestra.resolve.commands import run_command
from orchestra.resolve.context import POISON, Context, Poison, Value
from orchestra.resolve.evaluate import evaluate
from orchestra.resolve.ledger import Ledger
from orchestra.resolve.packages import InstalledPackages
from orchestra.resolve.scope import Scope
from orchestra.resolve.words import split

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from orchestra.description.text import Template


@dataclass
class Place:
    """One place of a launch file, with what is set there."""

    context: Context
    scope: Scope
    text: str = ""

    @property
    def problems(self) -> Problems:
        return self.context.problems

    def set(self, name: str, value: str | Poison) -> None:
        location = Location(point("set.yaml"))
        self.scope.set(name, value if isinstance(value, Poison) else Value(value, location), location)

    def write(self, text: str) -> Template:
        self.text = text
        return parse_template(text, _span, self.problems)

    def value(self, text: str) -> str | None:
        """Return what a text evaluates to, None for poison."""
        value = evaluate(self.write(text), self.context)
        return value.text if isinstance(value, Value) else None

    def words(self, text: str) -> list[str] | None:
        """Return the words that a text splits into, None for poison."""
        values = split(self.write(text), self.context)
        return None if isinstance(values, Poison) else [value.text for value in values]

    def stretch(self, span: Span | None) -> str:
        """Return what was written at a span of the text written last."""
        assert span is not None
        return self.text[span.column - 1 : span.end_column - 1]

    def refusal(self, text: str) -> Problem:
        """Evaluate a text that has one fault, and return the fault."""
        assert self.value(text) is None
        (problem,) = self.problems.errors
        return problem


def _span(start: int, end: int) -> Span:
    return Span("a.launch.yaml", 1, start + 1, 1, end + 1)


@pytest.fixture
def place(package: Path) -> Iterator[Place]:
    """The place where upstream's recorded probes were taken: some variables and environment, no file; a package.

    `$(eval)` sees the environment of the description as its own: that of the tests is put back.
    """
    outside = dict(os.environ)
    environment = {"E1": "envval", "PATH": "/usr/bin:/bin", "AMENT_PREFIX_PATH": str(package)}
    problems = Problems()
    scope = Scope(problems, Ledger(), environment)
    context = Context(problems, scope, environment, InstalledPackages(environment), run_command)
    made = Place(context, scope)
    for name, value in {"a": "A", "b": "true", "n": "3", "name": "a"}.items():
        made.set(name, value)
    made.set("poisoned", POISON)
    yield made
    os.environ.clear()
    os.environ.update(outside)


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """The prefix of the ament package `robot_description` with the executable `show_robot`."""
    prefix = tmp_path / "prefix"
    marker = prefix / "share/ament_index/resource_index/packages/robot_description"
    executable = prefix / "lib/robot_description/show_robot"
    (prefix / "share/robot_description").mkdir(parents=True)
    for file in (marker, executable):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("#!/bin/sh\n")
        file.chmod(0o755)
    return prefix
