"""What keeps a YAML or XML file from being read does not hide what else is wrong: it is read as it was meant.

What is suggested is put in place of what is wrong; where nothing is, each way to mend it is tried, and the one is taken
with which fewest mistakes are left. What is found where such a guess was made follows from it, and is not told.

Rejected: parsers that recover by themselves (lxml): what they leave out is no matter of what was meant.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

from orchestra.dataclass import dataclass
from orchestra.errors import Problems
from orchestra.fields import replace
from orchestra.load import xml_mends, yaml_mends
from orchestra.load.entities import describe
from orchestra.load.faults import Fault, RefusedError
from orchestra.load.mended import Mend, mended
from orchestra.load.offsets import Source, source
from orchestra.load.reader import Reader
from orchestra.location import Span, meet

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from orchestra.description.launch import Description
    from orchestra.errors import Problem

_MOST: Final = 20  # faults of one text
_LONGEST: Final = 200_000  # characters of a text that is read again and again
_MOST_READ: Final = 500_000  # characters, in all attempts together: two seconds
_REFUSED: Final = 4  # times faster is a text refused, and that explained, than read
_NOTHING: Final = 1_000  # mistakes: as bad as it gets
_WORD: Final = re.compile(r"[\w./~-]+")


@dataclass(frozen=True, slots=True)
class Reading:
    """What was read of a text in the end: the text itself, and what was made of it.

    `faults` kept it from being read; `doubted` are the ranges that may be meant otherwise.
    """

    whole: Source
    made: Any
    faults: tuple[Fault, ...]
    doubted: tuple[Span, ...]


def description_behind(text: str, path: str, file: str, language: str, reader: Reader) -> Description | None:
    """Return the description of a file that could not be read, as it was meant; None where that is not known."""
    is_xml = language == "xml_file" or (language == "launch_file" and text.lstrip().startswith("<"))
    mends = xml_mends if is_xml else yaml_mends

    def attempt(whole: Source) -> tuple[Description | None, Problems]:
        found = Problems()
        own = Reader(found, reader.included_from, text)
        tree = mends.tree(whole, own)
        return (None if tree is None else describe(tree, path, file, own)), found

    found = reading_behind(source(file, text), attempt, mends.mends, lambda made: _weight(*made))
    if found is None:
        return None
    for fault in found.faults[1:]:  # the first is told
        reader.error(fault.code, fault.message, fault.span, suggestion=fault.suggestion, notes=fault.notes)
    description: Description | None = found.made[0]
    problems: Problems = found.made[1]
    doubted = found.doubted
    if description is None or not description.actions:
        return description  # with what was left out for the fault there is nothing left
    reader.problems.extend(problem for problem in problems if not _is_doubted(problem, doubted))
    lost = {word for span in doubted for word in _words(text, span)}
    return replace(description, lost=description.lost | lost, doubted=doubted)


def reading_behind(
    whole: Source,
    attempt: Callable[[Source], Any],
    mends: Callable[[RefusedError, Source], Iterator[Mend]],
    weight: Callable[[Any], int],
) -> Reading | None:
    """Return what can be read of a text that has been refused, None where it is not known how.

    `attempt` reads a text, or raises `RefusedError`, for which `mends` gives what may have been meant.
    """
    faults, doubted = list[Fault](), list[Span]()
    attempts = _Attempts(attempt)
    error = _refusal(whole, attempts) if len(whole.text) <= _LONGEST else None
    for _ in range(_MOST):
        if error is None:
            break
        if not any(meet(error.fault.span, span) for span in doubted):
            faults.append(error.fault)
        step = _step(error, whole, attempts, mends, weight)
        if step is None:
            break
        doubted.append(_doubted(whole, step.mend, error.fault))
        whole, error = step.whole, step.error
        if error is None:
            return Reading(whole, step.made, tuple(faults), tuple(doubted))
    return None


@dataclass(frozen=True, slots=True)
class _Step:
    """A mend, the text with it, and what was made of that, or what the text is refused for."""

    mend: Mend
    whole: Source
    made: Any
    error: RefusedError | None = None


class _Attempts:
    """Reads texts until it has read so much that nobody waits for more."""

    def __init__(self, attempt: Callable[[Source], Any]) -> None:
        self._attempt = attempt
        self._left = _MOST_READ

    @property
    def are_over(self) -> bool:
        """Whether no more is to be read."""
        return self._left <= 0

    def __call__(self, whole: Source) -> Any:  # noqa: ANN401 - whatever is made of a text
        """Return what is made of a text. Raises `RefusedError`."""
        try:
            made = self._attempt(whole)
        except RefusedError as error:
            self._left -= max(error.at, len(whole.text) // _REFUSED)
            raise
        self._left -= len(whole.text)
        return made


def _step(
    error: RefusedError,
    whole: Source,
    attempt: _Attempts,
    mends: Callable[[RefusedError, Source], Iterator[Mend]],
    weight: Callable[[Any], int],
) -> _Step | None:
    """Return the best mend: what is read with it has fewest mistakes, else its parser gets furthest."""
    best: tuple[int, _Step] | None = None
    further: _Step | None = None
    reached = whole.place(error.at)[0]
    for mend in mends(error, whole):
        if attempt.are_over:
            break
        tried = mended(whole, mend.edits)
        try:
            made = attempt(tried)
        except RefusedError as following:
            at = tried.place(following.at)
            is_behind = at[0] > reached or (mend.doubted is None and at > whole.place(error.at))
            if is_behind and following.fault.span != error.fault.span:
                reached, further = at[0], _Step(mend, tried, None, following)
                if mend.doubted is None:
                    break
            continue
        heavy = weight(made) + _left_out(whole.text, mend)
        if best is None or heavy < best[0]:
            best = heavy, _Step(mend, tried, made)
        if mend.doubted is None or not heavy:
            break
    return further if best is None else best[1]


def _refusal(whole: Source, attempt: Callable[[Source], Any]) -> RefusedError | None:
    try:
        attempt(whole)
    except RefusedError as error:
        return error
    return None


def _doubted(whole: Source, mend: Mend, fault: Fault) -> Span:
    """Return the range in which what is found may follow from a mend."""
    span = fault.span if mend.doubted is None else whole.span(*mend.doubted)
    return Span(span.file, span.line, span.column, span.end_line, span.end_column)


def _is_doubted(problem: Problem, doubted: tuple[Span, ...]) -> bool:
    return problem.span is not None and any(meet(problem.span, other) for other in doubted)


def _weight(description: Description | None, problems: Problems) -> int:
    return len(problems) + (len(description.lost) if description is not None else _NOTHING)


def _left_out(text: str, mend: Mend) -> int:
    """Return how many words a mend takes away: else it would be best to leave out what is wrong."""
    return sum(
        max(0, len(_WORD.findall(text, begin, end)) - len(_WORD.findall(meant)))
        for begin, end, meant in mend.edits
    )


def _words(text: str, span: Span) -> list[str]:
    """Return the words on the lines of a range."""
    lines = text.splitlines()[span.line - 1 : span.end_line]
    return [word for line in lines for word in _WORD.findall(line)]
