"""Names that a description gives to nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.resolve.context import Evaluated, Poison
from orchestra.resolve.names import mended, node_name_fault
from orchestra.resolve.refusals import refuse_value

if TYPE_CHECKING:
    from orchestra.description.text import Template
    from orchestra.resolve.resolution import Resolution


def named(template: Template | None, run: Resolution) -> Evaluated | None:
    """Return the name of a node, None where none is given; one that rcl does not take is reported.

    A slash in front is taken away: upstream means to, and refuses the name.
    """
    value = run.evaluate(template)
    if value is None or isinstance(value, Poison):
        return value
    name = replace(value, text=value.text[1:]) if value.text.startswith("/") else value
    fault = node_name_fault(name.text)
    if fault is None:
        return name
    message = f"'{value.text}' cannot be a node's name: {fault.reason}"
    meant = mended(name.text, node_name_fault) if "/" not in name.text else None
    return refuse_value(value, run.problems, Code.BAD_NAME, message, meant=meant)
