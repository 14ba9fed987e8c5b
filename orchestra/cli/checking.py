"""What is wrong in a set of files, each problem once."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra import pipeline
from orchestra.errors import Code, Problem, Problems
from orchestra.load.files import load
from orchestra.location import Location, Span, displayed, point
from orchestra.resolve.mentions import files_named
from orchestra.resolve.packages import InstalledPackages
from orchestra.resolve.rcl.files import read_parameter_file

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.cli.targets import Target
    from orchestra.description.launch import Description
    from orchestra.resolve.inputs import Inputs

_LACKS = (Code.MISSING_ARGUMENT, Code.UNDEFINED_VARIABLE)


def problems_in(targets: Sequence[Target], inputs: Inputs) -> tuple[Problem, ...]:
    """Return the problems of all targets.

    A launch file that another of them includes is judged by how that one uses it: alone it would lack the arguments
    and variables that it is given there. Where a condition keeps it from being included, what it lacks is not told.
    """
    given = replace(inputs, launching=False)
    launch_files = [_LaunchFile(target.path, given) for target in targets if target.kind == "launch"]
    found = Problems()
    named = {path for file in launch_files for path in file.named}
    for file in _outermost(launch_files):
        lacks = _LACKS if file.path in named else ()
        found.extend(problem for problem in file.problems if problem.code not in lacks)
    for target in targets:
        if target.kind == "parameters":
            _read_parameters(target.path, found)
    return found.ordered


class _LaunchFile:
    """A launch file that has been taken through all stages that start nothing."""

    def __init__(self, path: str, inputs: Inputs) -> None:
        self.path = os.path.realpath(path)
        self.problems = Problems()
        self.included: set[str] = set()
        self.named: set[str] = set()
        self._environment = inputs.environment
        self._packages = InstalledPackages(inputs.environment)
        pipeline.collect(str(Path(path).absolute()), inputs, self.problems, load=self._load)

    def _load(
        self, path: str, problems: Problems, chain: tuple[Span, ...] = (), ending: str | None = None
    ) -> Description | None:
        if chain:
            self.included.add(os.path.realpath(path))
        description = load(path, problems, chain, ending)
        if description is not None:
            files = files_named(description, self._environment, self._packages)
            self.named.update(map(os.path.realpath, files))
        return description


def _outermost(files: Sequence[_LaunchFile]) -> list[_LaunchFile]:
    """Return the files that no other includes, and of files that include each other in a circle the first."""
    inner = {path for file in files for path in file.included - {file.path}}
    chosen = [file for file in files if file.path not in inner]
    reached = {path for file in chosen for path in (file.path, *file.included)}
    for file in files:
        if file.path not in reached:
            chosen.append(file)
            reached |= {file.path, *file.included}
    return chosen


def _read_parameters(path: str, problems: Problems) -> None:
    file = displayed(path)
    try:
        text = Path(path).read_bytes().decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        problems.error(
            Code.UNREADABLE_FILE, f"cannot read the parameter file {file}: {error}", Location(point(file))
        )
        return
    read_parameter_file(text, file, problems, ())
