"""Launch descriptions of files for user code that asks for them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.building import Described
from orchestra.compat.faults import ReportedError
from orchestra.compat.launch.launch_description import LaunchDescription
from orchestra.description.actions.opaque import OpaqueAction
from orchestra.errors import Problems
from orchestra.resolve.paths import beside

if TYPE_CHECKING:
    from orchestra.resolve.resolution import Resolution

ENDINGS = {"python": ".py", "xml": ".xml", "yaml": ".yaml"}


def load_description(path: str, language: str | None, run: Resolution) -> LaunchDescription:
    """Return the description of a launch file. Raises `ReportedError` with what is wrong with it."""
    found = Problems()
    there = beside(run.context.file, path)
    if there is None:
        raise ReportedError(f"there is no launch file {path}")
    ending = () if language is None else (ENDINGS[language],)
    description = run.load(there, found, run.context.included_from, *ending)
    if description is None or found.errors:
        message = found.errors[0].message if found.errors else f"{path} is no launch file"
        raise ReportedError(message, found.errors)
    for action in description.actions:
        if isinstance(action, OpaqueAction) and isinstance(action.target, LaunchDescription):
            return action.target
    return LaunchDescription([Described(action) for action in description.actions])
