"""Parameter files as rcl reads them.

rcl runs a small state machine over libyaml's events instead of building a tree, and what it makes of unusual files
follows from that machine; so the same states are kept here (`_Reader`), beside what the file plainly says, and a
warning is given where the two part. Source: `rcl_yaml_param_parser` (`parse_file_events`) of Jazzy; measured in
`tests/data/rcl-probes.jsonl` and tested against the real one.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, TypeAlias

from orchestra.errors import Code, Problems
from orchestra.load.offsets import source
from orchestra.location import Location, Span
from orchestra.patterns import pattern
from orchestra.pyyaml import yaml
from orchestra.resolve.rcl.duplicates import report_duplicates
from orchestra.resolve.rcl.hollow import NO_VALUE, commented_out
from orchestra.resolve.rcl.nesting import NESTED, as_text
from orchestra.resolve.rcl.opened import Unreadable
from orchestra.resolve.rcl.reader import ALIAS, Reader
from orchestra.resolve.rcl.strays import SECTION_KEY
from orchestra.resolve.rcl.surprises import BREAK, report_surprises
from orchestra.resolve.rcl.values import loader

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from orchestra.errors import Problem
    from orchestra.load.offsets import Source
    from orchestra.resolve.rcl.opened import OpenSection
    from orchestra.resolve.rcl.sections import Section

    _Change: TypeAlias = Callable[[Iterator[yaml.Event]], Iterator[yaml.Event]]

_ANCHORED: Final = pattern(r"\s*:\s+&\w+\s*$")
_EVERY_NODE: Final = ("/**", SECTION_KEY)


def read_parameter_file(
    text: str, file: str, problems: Problems, included_from: tuple[Span, ...] = (), *, template: bool = False
) -> tuple[Section, ...]:
    """Return the sections of a parameter file in order.

    Everything that rcl refuses is reported as an error (`PARAMETER_SYNTAX`, `PARAMETER_TYPE`), what it takes in a
    way that nobody means as a warning, what is set twice as `DUPLICATE_PARAMETER`. After an error the sections are
    those that could be read all the same.

    Of a `template`, in which `$(...)` may be evaluated first, names of nodes with such are not judged.
    """
    return _read(text, file, problems, included_from, lambda events: events, template=template)[0]


def read_kept(text: str, file: str, problems: Problems) -> tuple[tuple[Section, ...], bool]:
    """Return the sections of a file as `read_parameter_file` does, and whether none is lost to an error."""
    return _read(text, file, problems, (), lambda events: events)


def read_plain_file(
    text: str, file: str, problems: Problems, included_from: tuple[Span, ...] = ()
) -> tuple[Section, ...]:
    """Return one section, for every node, with the parameters of a file that has nothing but parameters.

    The parameters of components may come from such a file (launch_ros, `to_parameters_list`). Faults are reported as
    by `read_parameter_file`.
    """
    return _read(text, file, problems, included_from, _within_section)[0]


def _read(
    text: str,
    file: str,
    problems: Problems,
    included_from: tuple[Span, ...],
    changed: _Change,
    *,
    template: bool = False,
) -> tuple[tuple[Section, ...], bool]:
    text, found = text.removeprefix("\ufeff"), Problems()
    reader, sound = Reader(file, found, included_from, template=template), 0
    event: yaml.Event | None = None
    further: list[Section] = []
    try:
        for event in changed(yaml.parse(text, Loader=loader())):
            sound = len(found)
            reader.take(event)
    except yaml.YAMLError as error:

        def again(events: Iterator[yaml.Event], told: Problems) -> tuple[tuple[Section, ...], bool]:
            return _read(text, file, told, included_from, lambda _: changed(events), template=template)

        before = [*found][:sound]
        return _no_yaml(error, source(file, text), again, reader, before, problems)
    except UnicodeEncodeError:
        at = Location(Span(file, 1, 1, 1, 1), included_from)
        problems.error(Code.PARAMETER_SYNTAX, "not YAML: a lone surrogate", at)
        reader.lost = True
    except Unreadable:
        reader.lost = True  # it has reported why it cannot go on

        def events() -> Iterator[yaml.Event]:
            return changed(yaml.parse(text, Loader=loader()))

        # Here, because rcl reads most files.
        from orchestra.resolve.rcl.remaining import remaining_sections  # noqa: PLC0415

        further += remaining_sections(
            events, event, lambda: Reader(file, found, included_from, template=template)
        )
    sections = (*reader.sections(), *further)
    _amend(found, text)
    problems.extend(found)
    report_duplicates(sections, problems)
    report_surprises(sections, text, problems)
    _report_empty((*reader.found, *further) if reader.lost else (), problems)
    return sections, not reader.lost


def _no_yaml(
    error: yaml.YAMLError,
    whole: Source,
    again: Callable[[Iterator[yaml.Event], Problems], tuple[tuple[Section, ...], bool]],
    reader: Reader,
    before: Sequence[Problem],
    problems: Problems,
) -> tuple[tuple[Section, ...], bool]:
    """Return the sections of a file that is no YAML: as it was meant, else those above its fault."""
    # Here, because most files are YAML, and what explains why one is none takes time to import.
    from orchestra.load.yaml_faults import explained  # noqa: PLC0415
    from orchestra.resolve.rcl.as_meant import read_as_meant  # noqa: PLC0415

    fault = explained(error, whole)
    certain = tuple(_before(fault.span, before, reader.sections(), whole.text))
    meant = read_as_meant(whole, again, problems, reader.included_from, certain)
    if meant is not None:
        return meant
    problems.extend(certain)
    at = Location(fault.span, reader.included_from)
    problems.error(Code.PARAMETER_SYNTAX, fault.message, at, suggestion=fault.suggestion)
    _report_empty(reader.found, problems)
    return reader.sections(), False


def _report_empty(sections: Iterable[OpenSection | Section], problems: Problems) -> None:
    """Report the empty lists of a file that no node gets; of others those are told that count in a node."""
    for section in sections:
        for entry in section.entries:
            span = entry.location.span
            if entry.value is None and not entry.opens and span.end_column > span.column + 1:  # no bare '{'
                told = f"'{entry.name}' has no type here: an empty list or mapping"
                problems.error(Code.PARAMETER_TYPE, told, entry.location)


def _amend(found: Problems, text: str) -> None:
    """Add what only the text shows to what has been found; leave out what is told of mappings for aliases."""
    if any(problem.message == NESTED for problem in found):
        lines = BREAK.split(text)
        found.amend(lambda problem: as_text(problem, lines))
    if any(problem.message.endswith(NO_VALUE) for problem in found):
        written = BREAK.split(text)
        found.amend(lambda problem: commented_out(problem, written))
    if any(problem.message.startswith(ALIAS) for problem in found):
        # Here, because hardly any file has one.
        from orchestra.resolve.rcl.anchors import repeated  # noqa: PLC0415

        anchored = BREAK.split(text)
        found.amend(lambda problem: repeated(problem, anchored))
        found.amend(lambda problem: None if _is_anchored(problem, anchored) else problem)


def _is_anchored(problem: Problem, lines: Sequence[str]) -> bool:
    """Return whether something is told of a mapping that is there for aliases, which rcl does not take."""
    span = problem.span
    return (
        span is not None
        and not problem.message.startswith(ALIAS)
        and _ANCHORED.match(lines[span.line - 1], span.end_column - 1) is not None
    )


def _before(span: Span, problems: Sequence[Problem], sections: Sequence[Section], text: str) -> list[Problem]:
    """Return the problems that stand before a fault of the text: what stands behind it follows from it."""
    above = Problems()
    above.extend(problems)
    report_duplicates(sections, above)
    report_surprises(sections, text, above)
    return [problem for problem in above if problem.span is not None and problem.span < span]


def _within_section(events: Iterator[yaml.Event]) -> Iterator[yaml.Event]:
    """Put the mapping of a document below the keys that make it the section for every node."""
    for event in events:
        outermost = isinstance(event, yaml.MappingStartEvent)
        if outermost:
            for key in _EVERY_NODE:
                yield yaml.MappingStartEvent(None, None, implicit=True, **_marks(event))
                yield yaml.ScalarEvent(None, None, (True, False), key, **_marks(event))
        yield event
        if outermost:
            break
    yield from _closed_twice(events)


def _closed_twice(events: Iterator[yaml.Event]) -> Iterator[yaml.Event]:
    for event in events:
        if isinstance(event, yaml.DocumentEndEvent):
            for _ in _EVERY_NODE:
                yield yaml.MappingEndEvent(**_marks(event))
        yield event


def _marks(event: yaml.Event) -> dict[str, Any]:
    return {"start_mark": event.start_mark, "end_mark": event.start_mark}
