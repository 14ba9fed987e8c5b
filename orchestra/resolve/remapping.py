"""Remapping rules as written, evaluated and checked."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.location import is_python
from orchestra.resolve.context import Value
from orchestra.resolve.model import ResolvedRemap, new_remap
from orchestra.resolve.names import InvalidName, mended, rule_name_fault
from orchestra.resolve.refusals import refuse_value
from orchestra.resolve.remaps import read_rule

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.parts import Remap
    from orchestra.description.text import Template
    from orchestra.resolve.resolution import Resolution


def remap(source: Template, target: Template, run: Resolution) -> ResolvedRemap | None:
    """Return a rule, None where it cannot be one (which has been reported)."""
    left, right = run.evaluate(source), run.evaluate(target)
    if not isinstance(left, Value) or not isinstance(right, Value):
        return None
    try:
        read_rule(left.text, right.text)
    except InvalidName as error:
        value = left if error.name == left.text else right
        message = f"'{error.name}' cannot be a name: {error.fault.reason}"
        name = value.text.partition(":=")[0] if value is left else value.text
        meant = name if rule_name_fault(name) is None else mended(name, rule_name_fault)
        refuse_value(value, run.problems, Code.BAD_NAME, message, meant=meant)
        return None
    if left.text == right.text and _are_written_alike(source, target):
        message = f"'{left.text}' is remapped to itself"
        run.problems.warning(Code.IDLE_REMAP, message, right.location)
    return new_remap(left, right)


def _are_written_alike(source: Template, target: Template) -> bool:
    """Return whether two texts of a file are the same words."""
    written = source.constant
    return written is not None and written == target.constant and not is_python(source.span)


def remaps(written: Sequence[Remap], run: Resolution) -> tuple[tuple[ResolvedRemap, ...], bool]:
    """Return the rules of a node in order, and whether all of them are sound."""
    if not written:
        return (), True
    rules = []
    for item in written:
        rule = remap(item.from_, item.to, run)
        if rule is not None:
            rules.append(rule)
    return tuple(rules), len(rules) == len(written)
