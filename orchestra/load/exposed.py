"""Actions and substitutions that third parties have added to the language: consulted before a name is unknown.

What parses them is code of theirs, which hands back objects; these stand in the description as opaque.
"""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.seam import is_connected
from orchestra.errors import Problems
from orchestra.fields import replace

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.description.entity import Action
    from orchestra.description.text import Call, Part
    from orchestra.location import Span

ADDED_BY: Final[Mapping[str, str]] = MappingProxyType(
    {
        "gz_server": "ros_gz_sim",
        "gz_spawn_model": "ros_gz_sim",
        "ros_gz_bridge": "ros_gz_bridge",
        "spawn_controller": "launch_ros2_control",
        "trace": "tracetools_launch",
    }
)
"""Actions that packages of ROS 2 add, with the package: what they take is known only where it is installed."""

# All imports inside functions: they bring in what Python launch files import, which few files need.


def exposes_action(name: str) -> bool:
    """Return whether somebody has added an action of this name."""
    if not is_connected():
        return False
    from orchestra.compat.launch.frontend import parser  # noqa: PLC0415

    return parser.exposed_action(name) is not None


def exposed_action(
    name: str,
    content: Any,  # noqa: ANN401 - a tree
    at: Span,
    problems: Problems,
    included_from: tuple[Span, ...],
) -> Action | None:
    """Return the action that its own code makes of what stands in a file; None where that fails, which is reported."""
    from orchestra.compat.building import model_of  # noqa: PLC0415
    from orchestra.compat.launch.frontend.parser import Parser  # noqa: PLC0415
    from orchestra.load.trees import entity_of  # noqa: PLC0415

    try:
        return model_of(Parser.parse_action(entity_of(name, content, at)))
    except (Exception, SystemExit) as error:  # noqa: BLE001 - the boundary of user code
        _report(error, problems, included_from, at)
        return None


def exposed_part(call: Call, problems: Problems) -> tuple[Part, ...] | None:
    """Return what a substitution's own code makes of it; None where nobody has added one of this name.

    Where that code fails, which is reported, there are no parts.
    """
    if not is_connected():
        return None
    from orchestra.compat.launch.frontend import parse_substitution, parser  # noqa: PLC0415

    parse = parser.exposed_substitution(call.name)
    if parse is None:
        return None
    try:
        arguments = [parse_substitution.substitutions_of(argument) for argument in call.arguments]
        return tuple(parse_substitution.called(parse, arguments, call.span)._parts(call.span))  # noqa: SLF001 - compat's own
    except (Exception, SystemExit) as error:  # noqa: BLE001 - the boundary of user code
        _report(error, problems, (), call.span)
        return ()


def _report(error: BaseException, problems: Problems, included_from: tuple[Span, ...], at: Span) -> None:
    """Report what parsing has raised where the launch file has it: the code's own line is beside the point."""
    from orchestra.compat import faults  # noqa: PLC0415

    found = Problems()
    faults.report(error, found, included_from, at)
    for problem in found:
        if hasattr(error, "problems"):  # which know their places in the file
            problems.report(replace(problem, included_from=problem.included_from or included_from))
        elif problem.span == at:
            problems.report(problem)
        else:
            notes = (f"raised at {problem.span}", *problem.notes)
            problems.report(replace(problem, span=at, notes=notes))
