"""Lists of lists and of mappings, which no parameter can be: rcl takes a part of them, or refuses the file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.errors import Code, Problems
from orchestra.fields import replace
from orchestra.pyyaml import yaml
from orchestra.resolve.rcl.opened import OpenList, Unreadable

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from orchestra.errors import Problem
    from orchestra.location import Location

NESTED: Final = "a parameter cannot be a list of lists"
OF_MAPPINGS: Final = "a parameter cannot be a list of mappings"


@dataclass(slots=True)
class Nesting:
    """Leaves out such lists from where rcl refuses them; `open` are the lists and mappings that have not ended."""

    problems: Problems
    open: int = 0
    outer: OpenList | None = None

    def leaves_out(
        self, event: yaml.Event, lists: list[OpenList], depth: int, at: Callable[..., Location]
    ) -> bool:
        """Return whether an event belongs to a list that is left out; `lists`, which are open, are empty then.

        `depth` is how many mappings are open, `at` gives the place from one event to another. Raises `Unreadable` where
        a mapping in the lists has not ended.
        """
        if not self.open:
            if not _is_refused(event, lists, depth):
                return False
            self.outer, self.open = lists[0], len(lists)
            if depth != self.outer.depth:
                self._tell(event, at)
                raise Unreadable(NESTED)
            lists.clear()
        self.open += isinstance(event, yaml.CollectionStartEvent)
        self.open -= isinstance(event, yaml.CollectionEndEvent)
        if not self.open:
            self._tell(event, at)
        return True

    def _tell(self, end: yaml.Event, at: Callable[..., Location]) -> None:
        """Report a list: all of one in brackets on one line, else what is first in it."""
        outer = self.outer
        if outer is None or not outer.sound:
            return
        if outer.mapping is not None:
            self.problems.error(Code.PARAMETER_TYPE, OF_MAPPINGS, outer.mapping)
            return
        start, place = outer.start, outer.inner
        whole = at(start, end)
        flow = isinstance(start, yaml.SequenceStartEvent) and start.flow_style
        if place is None or (flow and whole.span.line == whole.span.end_line):
            place = whole
        self.problems.error(Code.PARAMETER_SYNTAX, NESTED, place)


def _is_refused(event: yaml.Event, lists: Sequence[OpenList], depth: int) -> bool:
    """Return whether rcl does not take an event: it expects a key, for a list or a mapping has ended in the list."""
    if isinstance(event, yaml.MappingStartEvent):
        return depth == lists[0].depth
    if isinstance(event, yaml.ScalarEvent):
        return lists[-1].items is None
    return isinstance(event, yaml.SequenceStartEvent)


def as_text(problem: Problem, lines: Sequence[str]) -> Problem:
    """Return the problem of a list of lists with the one text that nodes read instead, if it is all in one line."""
    span = problem.span
    if problem.message != NESTED or span is None or span.line != span.end_line:
        return problem
    written = lines[span.line - 1][span.column - 1 : span.end_column - 1]
    whole = written[:2].replace(" ", "") == "[[" and written[-1:] == "]"
    return replace(problem, suggestion=f'"{written}"') if whole and '"' not in written else problem
