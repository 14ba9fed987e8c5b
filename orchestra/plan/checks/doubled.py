"""Parameters that the list of one node sets twice, so that what is written first does nothing."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.location import is_python
from orchestra.plan.ids import node_name
from orchestra.resolve.model import InlineParameter

if TYPE_CHECKING:
    from orchestra.errors import Problems
    from orchestra.plan.model import Plan
    from orchestra.resolve.model import (
        FileParameters,
        Resolved,
        ResolvedComponent,
        ResolvedProcess,
    )


def check_doubled(resolved: Resolved, plan: Plan, problems: Problems) -> None:
    """Report values in the list of a node that a later one of the same list takes the place of.

    That values of a file are overruled behind it is how people use files. In Python lists are put together by code.
    """
    del plan
    nodes: list[ResolvedProcess | ResolvedComponent] = [*resolved.processes, *resolved.components]
    for node in nodes:
        _check(node, problems)


def _check(node: ResolvedProcess | ResolvedComponent, problems: Problems) -> None:
    first: dict[str, InlineParameter] = {}
    name = node_name(node)
    for source in node.parameters:
        if source.everywhere or is_python(source.location):
            continue
        if not isinstance(source, InlineParameter):
            _check_file(source, name, first, problems)
            continue
        earlier = first.setdefault(source.name, source)
        if earlier is not source and repr(earlier.value) != repr(source.value):
            problems.warning(
                Code.DUPLICATE_PARAMETER,
                f"'{source.name}' is set twice for this node; this value counts",
                source.keys[-1][1] if source.keys else source.location,
                notes=(f"set first at {earlier.location}",),
            )


def _check_file(
    source: FileParameters, name: str | None, first: dict[str, InlineParameter], problems: Problems
) -> None:
    """Report values before a file that has others for the very node, whose name it gives."""
    if name is None:
        return
    bare = name.removeprefix("/")
    for section in source.sections if first else ():
        if section.pattern.removeprefix("/") != bare:
            continue
        for entry in section.entries:
            earlier = first.get(entry.name)
            if earlier is None or entry.value is None or repr(entry.value) == repr(earlier.value):
                continue
            problems.warning(
                Code.DUPLICATE_PARAMETER,
                f"this value of '{entry.name}' does not count: a file behind it has another one",
                earlier.location,
                notes=(
                    f"the value that counts is at {entry.location}",
                    "a file stands before what overrules it",
                ),
            )
