"""Descriptions written in a test, resolved for real."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path

from orchestra.errors import Code, Problems
from orchestra.load.files import load
from orchestra.plan.build import build
from orchestra.plan.model import Plan, Process
from orchestra.resolve.command_line import inputs_from
from orchestra.resolve.commands import run_command
from orchestra.resolve.model import Resolved
from orchestra.resolve.packages import InstalledPackages
from orchestra.resolve.resolve import resolve


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a description came to."""

    resolved: Resolved
    plan: Plan
    problems: Problems

    @property
    def messages(self) -> list[str]:
        """What `log` actions say at the start."""
        return [
            action.message
            for trigger in self.plan.triggers
            for action in trigger.do
            if action.action == "log" and trigger.delay is None
        ]

    @property
    def faults(self) -> list[tuple[Code, str, int, int]]:
        """Code, file name, line and column of every problem."""
        return [
            (problem.code, Path(problem.span.file).name, problem.span.line, problem.span.column)
            for problem in self.problems.ordered
            if problem.span is not None
        ]

    def process(self, identity: str) -> Process:
        """Return a process of the plan."""
        return next(process for process in self.plan.processes if process.id == identity)


def outcome(
    folder: Path,
    files: dict[str, str] | str,
    *words: str,
    environment: dict[str, str] | None = None,
    params_files: tuple[str, ...] = (),
    launching: bool = True,
) -> Outcome:
    """Write launch files (the first is the one that is launched), resolve and plan them."""
    if isinstance(files, str):
        files = {"main.yaml": files}
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text.encode())
    problems = Problems()
    inputs = inputs_from(
        words,
        environment=dict(os.environ) if environment is None else environment,
        params_files=params_files,
    )
    inputs = replace(inputs, launching=launching)
    description = load(str(folder / next(iter(files))), problems)
    assert description is not None, list(problems)
    packages = InstalledPackages(inputs.environment)
    resolved = resolve(description, inputs, problems, load=load, packages=packages, run_command=run_command)
    return Outcome(resolved, build(resolved, problems), problems)
