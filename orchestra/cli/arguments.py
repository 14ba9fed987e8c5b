"""The launch arguments of a description, for people: `orchestra launch --show-args`.

What a resolution comes upon is told as it came to be there. What conditions left out is told as far as it can be seen
in the files, with a mark, because other arguments may let it in.
"""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

from orchestra import pipeline
from orchestra.cli import boundary
from orchestra.cli.glance.walk import declared
from orchestra.cli.inputs import file_and_inputs
from orchestra.dataclass import dataclass
from orchestra.errors import Code, DescriptionError, Problems
from orchestra.fields import replace
from orchestra.location import displayed
from orchestra.resolve.packages import InstalledPackages

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Iterator, Sequence

    from orchestra.cli.glance.walk import Declared
    from orchestra.plan.model import Argument

_NOTE = "* Only where a condition holds."


@dataclass(frozen=True, slots=True)
class _Shown:
    """An argument as it is shown: `value` is the one in force, `place` the file that declares it."""

    name: str
    description: str | None
    default: str | None
    value: str | None
    choices: tuple[str, ...]
    place: str
    conditional: bool


def show_arguments(options: Namespace) -> int:
    """Print the arguments on standard output, and what keeps them from being known on standard error.

    Where values are wanted that nobody gave, faults may only follow from that: then they count for nothing. Raises
    `UsageError`, and `DescriptionError` where the file cannot be read as a launch file.
    """
    path, given = file_and_inputs(options)
    problems = Problems()
    plan = pipeline.collect(path, replace(given, launching=False, required=False), problems)
    if plan is None:
        raise DescriptionError(problems.ordered)
    shown = _shown(
        [item for item in plan.arguments if not item.given], declared(path, InstalledPackages(os.environ))
    )
    if not shown and any(problem.code is Code.SYNTAX for problem in problems.errors):
        # Arguments may stand in what could not be read.
        raise DescriptionError(problems.ordered)
    sys.stdout.write(arguments_text(displayed(path), shown))
    if not problems.errors:
        return boundary.OK
    telling = boundary.Telling.of("launch", options)
    boundary.show_problems(
        problems.errors, telling.problem_format, sys.stderr, command_line=telling.command_line
    )
    lacking = any(item.default is None and item.value is None for item in plan.arguments)
    return boundary.OK if lacking else boundary.MISTAKE


def arguments_text(file: str, arguments: Sequence[_Shown]) -> str:
    """Return the text that shows arguments; its form is that of `ros2 launch --show-args`."""
    if not arguments:
        return f"{file} has no arguments.\n"
    lines = [f"Arguments of {file}, given as NAME:=VALUE:"]
    for argument in arguments:
        lines += ["", *_lines(argument, file)]
    if any(argument.conditional for argument in arguments):
        lines += ["", _NOTE]
    return "".join(f"{line}\n" for line in lines)


def _lines(argument: _Shown, file: str) -> Iterator[str]:
    yield f"    '{argument.name}':{'*' * argument.conditional}"
    for line in (argument.description or "no description").splitlines():
        yield f"        {line}"
    yield "        (required)" if argument.default is None else f"        (default: '{argument.default}')"
    if argument.value is not None and argument.value != argument.default:
        yield f"        (now: '{argument.value}')"
    if argument.choices:
        choices = ", ".join(f"'{choice}'" for choice in argument.choices)
        yield f"        (choices: {choices})"
    if argument.place != file:
        yield f"        (in {argument.place})"


def _shown(arguments: Sequence[Argument], seen: Sequence[Declared]) -> list[_Shown]:
    """Return what the resolution found, and then what only a glance shows."""
    conditional = {item.argument.name for item in seen if item.conditional}
    found = [
        _Shown(
            argument.name,
            argument.description,
            argument.default,
            argument.value,
            argument.choices or (),
            argument.location.span.file,
            argument.name in conditional,
        )
        for argument in arguments
    ]
    known = {argument.name for argument in arguments}
    for item in seen:
        if item.argument.name not in known:
            name, default, _, choices, description, _ = item.argument
            found.append(_Shown(name, description, default, None, choices, displayed(item.file), True))
    return found
