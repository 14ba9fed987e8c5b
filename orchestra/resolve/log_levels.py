"""Levels of logging among the arguments of a node: rcl refuses what is none, and the node ends at once.

Source: rcl, `_rcl_parse_log_level`; rcutils, `rcutils_logging_severity_level_from_string`. Case does not matter.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.location import is_python
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.errors import Problems
    from orchestra.location import Location
    from orchestra.resolve.context import Value

_OPTION: Final = "--log-level"
LEVELS: Final = ("debug", "info", "warn", "error", "fatal", "unset")


def check_levels(words: Sequence[Value], problems: Problems, *, for_ros: bool) -> None:
    """Report what is no level of logging where it stands; `for_ros` tells that all words are for rcl."""
    for word in _levels(words, for_ros=for_ros):
        level = word.text.rpartition(":=")[2]
        if level.lower() in LEVELS:
            continue
        near, place = nearest(level.lower(), LEVELS), _end_of(word, len(level))
        is_placed = place is not None or is_python(word.location)  # in Python the text is found later
        hint = "" if is_placed else f"; did you mean '{near}'?"
        if near is None:
            hint = f": it is one of {', '.join(LEVELS[:-1])}"
        problems.error(
            Code.MIDDLEWARE_SETTING,
            f"'{level}' is no level of logging{hint}",
            place or word.location,
            suggestion=near if is_placed else None,
        )


def _levels(words: Sequence[Value], *, for_ros: bool) -> Iterator[Value]:
    """Yield what follows the option among the words that rcl reads."""
    texts = [word.text for word in words]
    for index, text in enumerate(texts[:-1]):
        if text == _OPTION and (for_ros or "--ros-args" in texts[:index]) and "--" not in texts[:index]:
            yield words[index + 1]


def _end_of(word: Value, length: int) -> Location | None:
    """Return the place of the last characters of a word, None where they do not stand there as they are."""
    span = word.location.span
    if span.line != span.end_line or span.end_column - span.column != len(word.text):
        return None
    return replace(word.location, span=replace(span, column=span.end_column - length))
