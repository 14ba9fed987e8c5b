"""Conditions that are neither true nor false, and words that are read as such here and that ROS 2 refuses."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.description.fields import FLAG_WORDS
from orchestra.errors import Code
from orchestra.load.expressions import as_substitutions
from orchestra.location import Span, is_python
from orchestra.nearest import nearest
from orchestra.resolve.booleans import CONDITION_WORDS, boolean
from orchestra.resolve.command_line import COMMAND_LINE
from orchestra.resolve.refusals import forget_surprise, refuse_value, written_at

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from orchestra.description.text import Template
    from orchestra.resolve.context import Read, Value
    from orchestra.resolve.resolution import Resolution


def refuse_condition(template: Template, value: Value, run: Resolution) -> None:
    """Report a condition that is neither true nor false; one that is written as in Python is meant as substitutions."""
    message = f"a condition is true or false, this is '{value.text}'"
    if not value.verbatim and template.raw.endswith("))") and boolean(value.text.rstrip(")")) is not None:
        last = value.location.span
        at = Span(last.file, last.end_line, last.end_column - 1, last.end_line, last.end_column)
        run.problems.error(Code.BAD_CONDITION, f"{message}: the last ')' is too many", run.at(at))
        return
    meant = None if value.verbatim or is_python(value.location) else as_substitutions(template.raw)
    if meant is not None:
        run.problems.error(Code.BAD_CONDITION, message, value.location, suggestion=meant)
        return
    if _is_choice(template, value, run):
        return
    meant = nearest(value.text, FLAG_WORDS)
    refuse_value(value, run.problems, Code.BAD_CONDITION, message, meant=meant)


def _is_choice(template: Template, value: Value, run: Resolution) -> bool:
    """Report a condition that is an argument with choices of which none is true or false: it is to be compared."""
    name = value.through[0].name if len(value.through) == 1 else ""
    choices = run.found.choices_of(name) or ()
    if value.text.strip() not in choices or any(boolean(choice) is not None for choice in choices):
        return False
    message = f"a condition is true or false, and '{name}' is {' or '.join(choices)}"
    other = next((choice for choice in choices if choice != value.text), value.text)
    meant = None if is_python(template.span) else f"$(equals {template.raw.strip()} {other})"
    notes = () if meant else ("compare it, with LaunchConfigurationEquals or EqualsSubstitution",)
    run.problems.error(Code.BAD_CONDITION, message, run.at(template.span), suggestion=meant, notes=notes)
    return True


def check_word(value: Value, run: Resolution, *, holds: bool) -> None:
    """Tell that `yes` and its like are no condition elsewhere; what the caller gives is nothing to mend in a file."""
    if value.text.strip().lower() in CONDITION_WORDS or any(
        _is_of_the_caller(read) for read in _all(value.through)
    ):
        return
    at = value.location if value.verbatim else written_at(value)
    meant = "true" if holds else "false"
    message = f"'{value.text}' is no condition for ROS 2, which takes true, false, 1 and 0"
    notes = [] if at is None or at == value.location else [f"it is used at {value.location}"]
    if at is not None:
        forget_surprise(at.span, run.problems)
    else:
        notes.append(f"did you mean '{meant}'?")
    suggestion = None if at is None else meant
    run.problems.warning(
        Code.BAD_CONDITION, message, at or value.location, suggestion=suggestion, notes=notes
    )


def _is_of_the_caller(read: Read) -> bool:
    return read.kind == "environment" or (
        read.location is not None and read.location.span.file == COMMAND_LINE
    )


def _all(reads: Iterable[Read]) -> Iterator[Read]:
    for read in reads:
        yield read
        yield from _all(read.through)
