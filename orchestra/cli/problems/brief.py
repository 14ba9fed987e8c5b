"""Problems for people, notes last: a line for all that say the same, and not more lines than can be taken in.

Without ROS a tree of packages may have hundreds of notes, most of them that of one package at many places. They would
hide what is wrong: so they stand behind it, and most places are only counted.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.cli.problems.text import blocks, counts, headline
from orchestra.errors import HERE, Problem, Severity

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from orchestra.cli.colour import Paint
    from orchestra.cli.problems.sources import Sources

_MOST: Final = 10  # lines of notes


def render(problems: Sequence[Problem], sources: Sources, paint: Paint) -> str:
    """Return the problems as text, as that of `text`; of notes one line for each thing that they say."""
    if not problems:
        return ""
    grave = [problem for problem in problems if problem.severity is not Severity.NOTE]
    alike = _alike(problem for problem in problems if problem.severity is Severity.NOTE)
    lines = [f"{headline(places[0], paint)}{paint('note', _extent(places))}" for places in alike[:_MOST]]
    if len(alike) > _MOST:
        others = len(alike) - _MOST
        lines.append(paint("note", f"... and {others} other{'s' * (others != 1)}: see --notes all"))
    parts = [*blocks(grave, sources, paint), "".join(f"{line}\n" for line in lines)]
    return "\n".join([*filter(None, parts), f"{counts(problems)}\n"])


def _alike(notes: Iterable[Problem]) -> list[list[Problem]]:
    """Return the notes that say the same together, those first that are said at most places."""
    alike: dict[tuple[str, str], list[Problem]] = {}
    for note in notes:
        alike.setdefault((note.code, note.message.partition(HERE)[0]), []).append(note)
    return sorted(alike.values(), key=len, reverse=True)


def _extent(places: Sequence[Problem]) -> str:
    """Return at how many places and in how many files the same is said, nothing for one place."""
    files = len({note.span.file for note in places if note.span is not None})
    told = f"{len(places)} places" + (f" in {files} files" if files > 1 else "")
    return f" ({told})" if len(places) > 1 else ""
