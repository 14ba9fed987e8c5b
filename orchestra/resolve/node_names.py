"""Names that a description gives to nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.resolve.context import Evaluated, Poison
from orchestra.resolve.names import mended, node_name_fault
from orchestra.resolve.refusals import refuse_value, written_at

if TYPE_CHECKING:
    from orchestra.description.text import Template
    from orchestra.resolve.context import Value
    from orchestra.resolve.resolution import Resolution


def named(template: Template | None, run: Resolution) -> Evaluated | None:
    """Return the name of a node, None where none is given; one that rcl does not take is reported.

    A slash in front is taken away: upstream means to, and refuses the name. Of a path the last part is the name.
    """
    value = run.evaluate(template)
    if value is None or isinstance(value, Poison):
        return value
    name, fault = value, node_name_fault(value.text)
    if fault is None:
        return name
    if value.text[:1] == "/":
        name = replace(value, text=value.text[1:])
        fault = node_name_fault(name.text)
        if fault is None:
            warn_of_slash(value, run)
            return name
    message = f"'{value.text}' cannot be a node's name: {fault.reason}"
    last = name.text.rpartition("/")[2]
    meant = last if node_name_fault(last) is None else mended(last, node_name_fault)
    return refuse_value(value, run.problems, Code.BAD_NAME, message, meant=meant)


def warn_of_slash(value: Value, run: Resolution) -> None:
    """Tell of a slash in front of a name, which ROS 2 refuses."""
    message = f"'{value.text}' cannot be a node's name for ROS 2: the namespace is given apart"
    at = value.location if value.verbatim else written_at(value)
    suggestion = None if at is None else value.text.removeprefix("/")
    run.problems.warning(Code.BAD_NAME, message, at or value.location, suggestion=suggestion)
