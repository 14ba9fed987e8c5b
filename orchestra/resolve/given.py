"""Parameters of Orchestra's own command line: files for all nodes, single values for one."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.location import Location
from orchestra.resolve.context import Value
from orchestra.resolve.model import GivenSections
from orchestra.resolve.parameter_files import read_file
from orchestra.resolve.paths import file_below
from orchestra.resolve.rcl.overrides import override_value
from orchestra.resolve.rcl.patterns import pattern_fault
from orchestra.resolve.rcl.sections import Section, entry

if TYPE_CHECKING:
    from orchestra.resolve.inputs import GivenParameter
    from orchestra.resolve.resolution import Resolution


def given_sections(run: Resolution) -> tuple[GivenSections, ...]:
    """Return what the command line sets, files first, single values after them."""
    found = []
    for given in run.inputs.parameter_files:
        location = Location(given.span)
        path = file_below(str(Path.cwd()), Value(given.path, location), "parameter file", run)
        file = read_file(path, location, run) if path is not None else None
        if file is not None:
            found.append(GivenSections(file.sections, location, strict=False))
    values = [_value(given, run) for given in run.inputs.parameters]
    return (*found, *(value for value in values if value is not None))


def _value(given: GivenParameter, run: Resolution) -> GivenSections | None:
    location = Location(given.span)
    pattern = given.node if given.node.startswith("/") else f"/{given.node}"
    fault = pattern_fault(pattern)
    if fault is not None:
        message = f"'{given.node}' cannot be a node: {fault.reason}"
        run.problems.error(Code.PARAMETER_TYPE, message, location)
        return None
    try:
        value = override_value(given.value)
        if value is None:
            raise ValueError(f"'{given.value}' has no type")  # noqa: TRY301 - one report for both
    except ValueError as error:
        run.problems.error(Code.PARAMETER_TYPE, " ".join(str(error).split()), Location(given.value_span))
        return None
    section = Section(pattern, (entry(given.name, value, location),), location)
    return GivenSections((section,), location, strict=True)
