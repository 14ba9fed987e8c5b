"""Launch descriptions of files for user code that asks for them."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from orchestra.compat.building import Described
from orchestra.compat.launch.launch_description import LaunchDescription
from orchestra.description.actions.opaque import OpaqueAction
from orchestra.errors import Problems
from orchestra.resolve.paths import beside
from orchestra.resolve.python.failures import failure

if TYPE_CHECKING:
    from orchestra.compat.launch.frontend.parser import Parser
    from orchestra.resolve.resolution import Resolution

ENDINGS = {"python": ".py", "xml": ".xml", "yaml": ".yaml"}
_PARSERS = {
    None: "orchestra.compat.launch.frontend",
    "xml": "orchestra.compat.launch_xml",
    "yaml": "orchestra.compat.launch_yaml",
}


def load_description(path: str, language: str | None, run: Resolution) -> LaunchDescription:
    """Return the description of a launch file.

    Raises `RuntimeError`, or what else upstream does, with what is wrong with it.
    """
    found = Problems()
    there = beside(run.context.file, path)
    if there is None:
        raise FileNotFoundError(f"there is no launch file {path}")
    ending = () if language is None else (ENDINGS[language],)
    description = run.load(there, found, run.context.included_from, *ending)
    error = failure(found.errors)
    if error is not None:
        raise error
    if description is None:
        raise RuntimeError(f"{path} is no launch file")
    for action in description.actions:
        if isinstance(action, OpaqueAction) and isinstance(action.target, LaunchDescription):
            return action.target
    return _parsed(there, language) or LaunchDescription(
        [Described(action) for action in description.actions]
    )


def _parsed(path: str, language: str | None) -> LaunchDescription | None:
    """Return what a file in XML or YAML describes as the objects that Python files are made of.

    None where that says less than the file does: it has keys that only Orchestra knows.
    """
    parser: type[Parser] = import_module(_PARSERS[language]).Parser
    try:
        root, found = parser.load(path)
        return found.parse_description(root)
    except (AttributeError, RuntimeError, TypeError, ValueError):
        return None
