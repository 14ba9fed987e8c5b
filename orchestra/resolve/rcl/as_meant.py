"""Parameter files that are no YAML, read as they were meant: what is wrong in them elsewhere is told, too."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.errors import Code, Problems
from orchestra.fields import replace
from orchestra.load.carrying_on import reading_behind
from orchestra.load.faults import RefusedError
from orchestra.load.yaml_faults import explained, failed_at
from orchestra.load.yaml_mends import mends
from orchestra.location import Location, meet
from orchestra.pyyaml import yaml
from orchestra.resolve.rcl.values import loader

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from typing import TypeAlias

    from orchestra.errors import Problem
    from orchestra.load.offsets import Source
    from orchestra.location import Span
    from orchestra.resolve.rcl.sections import Section

    _Read: TypeAlias = tuple[tuple[Section, ...], bool]

_INCOMPLETE = 10  # mistakes: as bad as it is to lose sections


def read_as_meant(
    whole: Source,
    read: Callable[[Iterator[yaml.Event], Problems], _Read],
    problems: Problems,
    included_from: tuple[Span, ...],
    certain: Sequence[Problem] = (),
) -> _Read | None:
    """Return the sections of a file that is no YAML, and whether none is lost; None where it is not known how.

    `read` makes sections of events. What is wrong is reported, but for what may follow from a guess; what is `certain`
    has been found above all of them.
    """

    def attempt(tried: Source) -> tuple[_Read, Problems]:
        try:
            events = list(yaml.parse(tried.text, Loader=loader()))
        except yaml.YAMLError as error:
            raise RefusedError(explained(error, tried), failed_at(error, tried)) from None
        found = Problems()
        return read(_placed(events, tried), found), found

    reading = reading_behind(whole, attempt, mends, _weight)
    if reading is None:
        return None
    (sections, kept), found = reading.made
    for fault in reading.faults:
        at = Location(fault.span, included_from)
        problems.error(Code.PARAMETER_SYNTAX, fault.message, at, suggestion=fault.suggestion)

    def follows(span: Span | None) -> bool:
        return span is not None and any(meet(span, other) for other in reading.doubted)

    around = {line for span in reading.doubted for line in _around(whole.text.splitlines(), span.line)}
    problems.extend(
        problem
        for problem in found
        if problem in certain
        or (not follows(problem.span) and (problem.span is None or problem.span.line not in around))
    )
    is_plain = all(span.line == span.end_line for span in reading.doubted)
    whole_sections = not any(follows(section.location.span) for section in sections)
    return tuple(_without(section, follows) for section in sections), kept and is_plain and whole_sections


def _around(lines: list[str], line: int) -> Iterator[int]:
    """Yield the lines of the keys that a line stands below."""
    at = min(line, len(lines)) - 1
    own = _indent(lines[at]) if at >= 0 else 0
    for above in range(at - 1, -1, -1):
        if lines[above].strip() and _indent(lines[above]) < own:
            own = _indent(lines[above])
            yield above + 1


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip())


def _placed(events: list[Any], whole: Source) -> Iterator[yaml.Event]:
    """Yield events with the places that they have in the file."""
    for event in events:
        event.start_mark = _mark(event.start_mark, whole)
        event.end_mark = _mark(event.end_mark, whole)
        yield event


def _mark(mark: Any, whole: Source) -> yaml.Mark:  # noqa: ANN401 - a mark of either parser
    line, column = whole.place(min(mark.index, len(whole.text)))
    return yaml.Mark(mark.name, mark.index, line - 1, column - 1, None, 0)


def _without(section: Section, follows: Callable[[Span | None], bool]) -> Section:
    """Return a section without the entries that may follow from a guess."""
    return replace(
        section, entries=tuple(item for item in section.entries if not follows(item.location.span))
    )


def _weight(made: tuple[_Read, Problems]) -> int:
    return len(made[1]) + (0 if made[0][1] else _INCOMPLETE)
