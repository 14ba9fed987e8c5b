"""Puts the run directory into a plan and writes what its processes read from there."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from orchestra.fields import replace
from orchestra.plan.parameter_file import contents
from orchestra.supervise.process.spec import RUN_FOLDER, filled, located

if TYPE_CHECKING:
    from orchestra.plan.model import Plan
    from orchestra.supervise.reactions.fragment import Fragment

    Records = TypeVar("Records", Plan, Fragment)


def furnish(records: Records, folder: str) -> Records:
    """Write the parameter files; return the plan, or the part of one, with `${run}` filled in. Raises `OSError`."""
    processes = tuple(located(process, folder) for process in records.processes)
    for planned, process in zip(records.processes, processes, strict=True):
        if not (planned.parameters or planned.parameter_files):
            continue
        # Files are known by what the command of the plan calls them.
        for path, text in contents(replace(process, command=planned.command)).items():
            with open(path.replace(RUN_FOLDER, folder), "w", encoding="utf-8") as file:  # noqa: PTH123 - may be any path
                file.write(text)
    components = tuple(
        replace(
            component,
            parameters=filled(component.parameters, folder),
            extra_arguments=filled(component.extra_arguments, folder),
        )
        for component in records.components
    )
    return replace(records, processes=processes, components=components)
