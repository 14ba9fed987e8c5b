"""Namespaces below namespaces, and what is wrong with them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.context import POISON, Evaluated, Poison, Read, Value, new_read
from orchestra.resolve.late_values import placed_value
from orchestra.resolve.names import joined, mended, namespace_fault
from orchestra.resolve.refusals import refuse_value
from orchestra.resolve.scope import NAMESPACE

if TYPE_CHECKING:
    from orchestra.description.entity import Entity
    from orchestra.description.text import Template
    from orchestra.errors import Problems
    from orchestra.resolve.resolution import Resolution


def below(base: Evaluated | None, namespace: Evaluated | None, problems: Problems) -> Evaluated | None:
    """Return the absolute namespace of a base and what is added to it; a name that cannot be one is reported."""
    if isinstance(namespace, Poison):
        return POISON
    if isinstance(base, Poison):
        if namespace is None or not namespace.text.startswith("/"):
            return POISON
        base = None
    text = joined(None if base is None else base.text, None if namespace is None else namespace.text)
    if text is None:
        return None
    written = namespace or base
    assert written is not None  # noqa: S101 - with neither there is no text
    fault = namespace_fault(text)
    if fault is not None:
        message = f"'{text}' cannot be a namespace: {fault.reason}"
        outer = base.text if base else None
        meant = mended(written.text, lambda name: namespace_fault(joined(outer, name) or ""))
        return refuse_value(written, problems, Code.BAD_NAME, message, meant=meant)
    around = () if base is None else (pushed(base),)
    return placed_value(text, written, around if namespace is None else around + namespace.through)


def pushed(base: Value) -> Read:
    """Return what is noted of the namespace that something stands in."""
    return new_read("namespace", "", base.text, "push", base.location, base.through)


def namespace_at(written: Template | None, node: Entity, run: Resolution) -> Evaluated | None:
    """Return the namespace of a node: what is written, below what has been pushed."""
    variable = run.scope.variables.get(NAMESPACE)
    if variable is None and written is None:
        return None
    base = None if variable is None else variable.value
    if variable is not None and variable.leaked_from is not None:
        base = run.scope.namespace(run.place(node))  # warns
    if written is not None:
        return below(base, run.evaluate(written), run.problems)
    if run.inherited is None or run.inherited[0] is not base:  # most nodes of a group stand in the same
        found = below(base, None, run.problems)
        if not isinstance(base, Value) or not isinstance(found, Value):
            return found
        run.inherited = base, found
    return run.inherited[1]
