"""Parameters that the list of one node sets twice, so that what is written first does nothing."""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.location import is_python
from orchestra.plan.ids import node_name
from orchestra.resolve.model import FileParameters, InlineParameter

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.errors import Problems
    from orchestra.plan.model import Plan
    from orchestra.resolve.model import (
        ParameterSource,
        Resolved,
        ResolvedComponent,
        ResolvedProcess,
    )
    from orchestra.resolve.rcl.sections import Entry, Section

_NAME: Final = attrgetter("name")


def check_doubled(resolved: Resolved, plan: Plan, problems: Problems) -> None:
    """Report values in the list of a node that a later one of the same list takes the place of, each name once.

    That values of a file are overruled behind it is how people use files. In Python lists are put together by code.
    """
    del plan
    losing = {problem.span for problem in problems if problem.code is Code.OVERRULED_PARAMETER}
    nodes: list[ResolvedProcess | ResolvedComponent] = [*resolved.processes, *resolved.components]
    sections = _Sections()
    for node in nodes:
        if len(node.parameters) < 2 or _are_apart(node.parameters):  # noqa: PLR2004 - nothing stands before it
            continue
        own = [item for item in node.parameters if not item.everywhere and not is_python(item.location)]
        inline = [item for item in own if isinstance(item, InlineParameter)]
        told = {item.name for item in inline if item.location.span in losing} if losing else set()
        _check_values(inline, told, problems)
        if inline and len(own) > len(inline):
            _check_files(own, node_name(node), sections, told, problems)


def _are_apart(parameters: Sequence[ParameterSource]) -> bool:
    """Return whether no name stands twice, and no file behind a name: most lists are such."""
    kinds = [*map(type, parameters)]
    if FileParameters not in kinds:
        return len({*map(_NAME, parameters)}) == len(kinds)
    names = {item.name for item in parameters if type(item) is InlineParameter}
    return len(names) == kinds.count(InlineParameter) and InlineParameter not in kinds[: -len(names) or None]


def _check_values(inline: Sequence[InlineParameter], told: set[str], problems: Problems) -> None:
    first: dict[str, InlineParameter] = {}
    for source in inline:
        earlier = first.setdefault(source.name, source)
        if earlier is source or repr(earlier.value) == repr(source.value) or source.name in told:
            continue
        told.add(source.name)
        problems.warning(
            Code.DUPLICATE_PARAMETER,
            f"'{source.name}' is set twice for this node; this value counts",
            source.keys[-1][1] if source.keys else source.location,
            notes=(f"set first at {earlier.location}",),
        )


def _check_files(
    own: Sequence[ParameterSource],
    name: str | None,
    sections: _Sections,
    told: set[str],
    problems: Problems,
) -> None:
    """Report values before a file that has others for the very node, whose name it gives."""
    before: dict[str, InlineParameter] = {}
    for source in own if name is not None else ():
        if isinstance(source, InlineParameter):
            before[source.name] = source
            continue
        for entry in sections.entries(source, name or "") if before else ():
            earlier = before.get(entry.name)
            if earlier is None or entry.value is None or entry.name in told:
                continue
            if repr(entry.value) != repr(earlier.value):
                told.add(entry.name)
                _report(entry, earlier, problems)


class _Sections:
    """The sections of files by their patterns; each file is gone through once."""

    def __init__(self) -> None:
        self._files: dict[int, dict[str, list[Section]]] = {}

    def entries(self, source: FileParameters, name: str) -> Iterator[Entry]:
        """Yield what a file has for the very node."""
        known = self._files.get(id(source.sections))
        if known is None:
            known = self._files[id(source.sections)] = {}
            for section in source.sections:
                known.setdefault(section.pattern.removeprefix("/"), []).append(section)
        for section in known.get(name.removeprefix("/"), ()):
            yield from section.entries


def _report(entry: Entry, earlier: InlineParameter, problems: Problems) -> None:
    problems.warning(
        Code.DUPLICATE_PARAMETER,
        f"this value of '{entry.name}' does not count: a file behind it has another one",
        earlier.location,
        notes=(f"the value that counts is at {entry.location}", "a file stands before what overrules it"),
    )
