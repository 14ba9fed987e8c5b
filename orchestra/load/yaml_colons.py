"""A second colon in one line of YAML: a text that needs quotes, or a mapping that belongs on lines of its own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.description.actions import model_of
from orchestra.load.keys import spelled
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from orchestra.load.faults import Fault
    from orchestra.load.yaml_failure import Failure

_FIRST: Final = pattern(r"[ ]*(?:- +)*([^\s:#\"'\[\]{}]+):[ ]+(?=[^\s\"'\[\]{}|>&*])")
# Keys that hold keys, besides the names of actions.
_HOLDING: Final = ("launch", "param", "remap", "env", "arg", "let", "children", "ros__parameters")


def of_second_colon(failure: Failure) -> Fault:
    """Return the fault of a colon behind a value: all of the value is a text, unless its key holds something else."""
    message = "a text with ': ' in it needs quotes"
    found = _FIRST.match(failure.text, failure.whole.lines[failure.line_of(failure.at) - 1])
    if found is None or found.end() >= failure.at:
        return failure.fault(message, failure.at, failure.at + 1)
    begin, end = found.end(), failure.line_end(found.end())
    holds = found[1] in _HOLDING or model_of(spelled(found[1])) is not None
    return failure.fault(message, begin, end, None if holds else in_quotes(failure.text[begin:end]))


def in_quotes(text: str) -> str | None:
    """Return a text in quotes, None where neither kind can stand around it as it is."""
    return next(
        (f"{quote}{text}{quote}" for quote in ('"', "'") if quote not in text and "\\" not in text), None
    )
