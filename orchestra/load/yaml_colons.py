"""Lines of YAML that are one text to who wrote them, and something else to YAML.

A second colon needs quotes, or is that of a mapping that belongs on lines of its own; brackets at the beginning need
quotes; a comment of another language begins with '#' here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.description.actions import model_of
from orchestra.load.keys import spelled
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from orchestra.load.faults import Fault
    from orchestra.load.yaml_failure import Failure

_FIRST: Final = pattern(r"[ ]*(?:- +)*([^\s:#\"'\[\]{}]+):[ ]+(?=[^\s\"'\[\]{}|>&*])")
# The beginning of a value that has more behind it: `{ns}/odom`.
_BRACKETED: Final = pattern(r"(?:[:-]|^)[ ]+(\{[^{}\n:]*\}|\[[^\[\]\n]*\])[ ]*$")
_COMMENT: Final = pattern(r"(?://|--|;)\s*(\w.*)|<!--\s*(.*?)\s*-->")
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


def of_brackets(failure: Failure, begin: int) -> Fault | None:
    """Return the fault of a text behind brackets that its line begins with, None where there are none."""
    found = _BRACKETED.search(failure.text[begin : failure.at])
    if found is None:
        return None
    start = begin + found.start(1)
    end = failure.line_end(start)
    message = "a text that begins with a bracket needs quotes"
    return failure.fault(message, start, end, in_quotes(failure.text[start:end]))


def in_quotes(text: str) -> str | None:
    """Return a text in quotes, None where neither kind can stand around it as it is."""
    return next(
        (f"{quote}{text}{quote}" for quote in ('"', "'") if quote not in text and "\\" not in text), None
    )


def comment_meant(line: str) -> str | None:
    """Return the comment that a line is in another language, None for any other line."""
    found = _COMMENT.fullmatch(line)
    return None if found is None else f"# {found[1] or found[2]}"
