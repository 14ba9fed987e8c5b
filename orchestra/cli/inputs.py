"""What `launch` and `plan` read alike: the launch file, its arguments, parameters and parameter files."""

from __future__ import annotations

import os
import sys
from contextlib import nullcontext
from typing import TYPE_CHECKING

from orchestra.cli import boundary, launch_prefix, leaving, severities
from orchestra.errors import DescriptionError, Problems, Severity, UsageError
from orchestra.fields import replace
from orchestra.witness.observing import observer
from orchestra.witness.variables import ObservedEnvironment

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Callable, Sequence
    from contextlib import ExitStack

    from orchestra.errors import Problem
    from orchestra.pipeline import Launch
    from orchestra.plan.model import Plan
    from orchestra.resolve.inputs import Inputs

EPILOG = """\
words after the launch file:
  NAME:=VALUE        a launch argument
  NODE:NAME:=VALUE   a parameter of one node; it wins over all that the description says

The launch file is a path, the name of a package and that of a file in it, or both in one word: nav2_bringup/bringup
for the one launch file bringup.launch.py, bringup_launch.py, bringup.launch.xml ... of the package.
"""


def add_to(parser: ArgumentParser) -> None:
    """Let a parser read them."""
    parser.add_argument("words", nargs="*", metavar="FILE | PACKAGE FILE [NAME:=VALUE ...]", help="see below")
    parser.add_argument(
        "--params-file",
        action="append",
        default=[],
        metavar="FILE",
        help="a parameter file for every node; it wins over the description; may be given more than once",
    )
    launch_prefix.add_to(parser)
    parser.add_argument("--strict", action="store_true", help="take warnings for errors")
    severities.add_to(parser)


def file_and_inputs(options: Namespace) -> tuple[str, Inputs]:
    """Return the path of the launch file that is meant, and what is given to it. Raises `UsageError`."""
    if not options.words:
        raise UsageError("a launch file is missing")
    from orchestra import pipeline  # noqa: PLC0415 - heavy, and `--help` does not need it

    launch_prefix.check(options)
    file, words = pipeline.find_launch_file(options.words)
    return file, inputs_of(words, options)


def inputs_of(words: Sequence[str], options: Namespace) -> Inputs:
    """Return what the words after a launch file and the options give to it. Raises `UsageError`."""
    from orchestra import pipeline  # noqa: PLC0415 - as above

    words = (*words, *launch_prefix.words(options))
    watching = observer()
    with watching.aside():
        given = pipeline.inputs_from(words, environment=os.environ, params_files=options.params_file)
        environment = ObservedEnvironment(given.environment, watching)
    if watching.active:
        given = replace(given, environment=environment)
    debug, noninteractive = getattr(options, "debug", False), getattr(options, "noninteractive", True)
    weights = severities.given(options)
    keeping = not getattr(options, "no_cache", False)
    return replace(given, debug=debug, noninteractive=noninteractive, severity=weights, keeping=keeping)


def plan_from(options: Namespace, *, launching: bool) -> Plan:
    """Make the plan that the options ask for.

    Raises `UsageError` and `DescriptionError`; with `--strict` also where there are only warnings.
    """
    from orchestra import pipeline  # noqa: PLC0415 - heavy, and `--help` does not need it

    file, given = file_and_inputs(options)
    with nullcontext() if launching else leaving.contained():
        plan = pipeline.make_plan(file, replace(given, launching=launching))
    if options.strict and has_warnings(plan):
        raise DescriptionError(as_errors(plan.problems))
    return plan


def launch_from(options: Namespace, lasting: ExitStack, postponed: list[Callable[[], None]]) -> Launch:
    """Make the plan that is to be run; code of its launch files can be called until `lasting` closes.

    What is kept of them for other plans waits in `postponed` from then on.
    Raises `UsageError` and `DescriptionError`, as `plan_from`.
    """
    from orchestra import pipeline  # noqa: PLC0415 - heavy, and `--help` does not need it

    file, given = file_and_inputs(options)
    problems = Problems()
    launch = lasting.enter_context(pipeline.opened(file, given, problems, postponed=postponed))
    if launch is None or problems.errors:
        raise DescriptionError(problems.ordered)
    if options.strict and has_warnings(launch.plan):
        raise DescriptionError(as_errors(launch.plan.problems))
    return launch


def warn(plan: Plan, options: Namespace) -> None:
    """Print the warnings of a plan on standard error."""
    boundary.tell(warnings_text(plan.problems, options))


def warnings_text(problems: tuple[Problem, ...], options: Namespace) -> str:
    """Return the text that shows warnings on standard error."""
    telling = boundary.Telling.of("", options)
    if not problems and telling.problem_format == "text":
        return ""  # as what renders them would return, and needs not be imported for
    return boundary.problems_text(
        problems, telling.problem_format, sys.stderr, command_line=telling.command_line
    )


def as_errors(problems: tuple[Problem, ...]) -> tuple[Problem, ...]:
    """Return the problems, warnings turned into errors. Notes stay: they are no fault of what is written."""
    return tuple(
        replace(problem, severity=Severity.ERROR) if problem.severity is Severity.WARNING else problem
        for problem in problems
    )


def has_warnings(plan: Plan) -> bool:
    """Return whether a plan has warnings, which `--strict` takes for errors."""
    return any(problem.severity is Severity.WARNING for problem in plan.problems)
