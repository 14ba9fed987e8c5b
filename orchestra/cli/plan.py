"""`orchestra plan`: show what a launch file would start, compare it, explain it, and start nothing."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Any, Final

from orchestra.cli import boundary, colour, inputs
from orchestra.cli.answered import Watch, give
from orchestra.cli.leaving import spare
from orchestra.cli.plain import plain
from orchestra.cli.remembered import NO_CACHE
from orchestra.errors import DescriptionError, UsageError

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Sequence

    from orchestra.cli.parser import CommandParser
    from orchestra.cli.planning.sources import Made


FORMATS: Final = ("text", "json", "yaml", "sh", "mermaid", "dot", "svg")
_OF_ANSWERS: Final = ("text", "json")
_DIFFERENT: Final = 1
_EPILOG = f"""\
{inputs.EPILOG}
A plan that `--format json` or `--format yaml` has written may stand for the launch file.

words after --diff, up to the next option:
  FILE [NAME:=VALUE ...]  another launch file, the same one with other arguments, or a plan that has been saved
  NAME:=VALUE ...         the same launch file with these arguments instead
  REV | REV:PATH          the launch file as it was in a git revision, with all that it includes
What is shown is what would happen to a run of that plan for it to become one of the first.

subjects of --explain: NODE, NODE.PARAMETER, NODE:TOPIC, NODE$VARIABLE
"""


def parser() -> CommandParser:
    """Return what the command understands."""
    # Slow, and of no use where the options are plain.
    from orchestra.cli.parser import CommandParser  # noqa: PLC0415

    made = CommandParser("plan", "Show what a launch file would start, and start nothing.", _EPILOG)
    _add_to(made)
    return made


def _add_to(made: Any) -> None:  # noqa: ANN401 - argparse's parser, or what stands for it
    made.add_argument("--format", choices=FORMATS, default="text", help="how to show it (default: text)")
    made.add_argument(
        "--node",
        action="append",
        default=[],
        metavar="GLOB",
        help="only these processes and components: names, patterns, namespaces as /robot1/; may be repeated",
    )
    made.add_argument(
        "--portable", action="store_true", help="symbols for paths of this machine: for snapshots"
    )
    made.add_argument("--host", action="store_true", help="show what a run adds to the environment here")
    asking = made.add_mutually_exclusive_group()
    asking.add_argument("--diff", nargs="+", metavar="WORD", help="compare with another plan, see below")
    asking.add_argument(
        "--explain", action="append", metavar="SUBJECT", help="show where values come from, see below"
    )
    made.add_argument("--exit-code", action="store_true", help="with --diff: end with 1 where they differ")
    made.add_argument(NO_CACHE, action="store_true", help="make the plan, also where nothing has changed")
    inputs.add_to(made)


def read(words: Sequence[str]) -> Any:  # noqa: ANN401 - what argparse makes of them
    """Return the options that words are, and the words. Raises `UsageError`, or `SystemExit` after `--help`."""
    options: Any = plain(words, _add_to) or parser().read(words)
    options.given = tuple(words)
    return options


def run(options: Namespace) -> int:
    """Print the plan on standard output; its warnings, in text, and all errors go to standard error."""
    _check(options)
    from orchestra.cli.planning import sources  # noqa: PLC0415 - heavy, and `--help` does not need it

    if options.diff:
        made = sources.made(options)
        sys.stderr.write(_told(options, made))
        return _compare(options, made, _paint())
    # What a run adds here, and files that code has written, are others each time.
    watch = Watch(None if options.host or options.format == "sh" else options.given)
    paint = _paint()
    with watch.watching():
        made = sources.made(options)
        told = _told(options, made)
        text = _explained(options, made, paint) if options.explain else _shown(options, made, paint)
    answer = text.encode(errors="surrogateescape")  # words may have bytes that are no Unicode
    give(answer, told)
    spare(made)
    if made.file is not None and not made.files:
        watch.keep(answer, told)
    return boundary.OK


def _paint() -> colour.Paint:
    return colour.painter(enabled=colour.wanted(sys.stdout, os.environ))


def _told(options: Namespace, made: Made) -> str:
    """Return the warnings as text; in JSON and YAML they are part of the plan."""
    return "" if options.format in ("json", "yaml") else inputs.warnings_text(made.plan.problems, options)


def _explained(options: Namespace, made: Made, paint: colour.Paint) -> str:
    from orchestra.cli.planning.explanation import explained  # noqa: PLC0415 - only this needs it

    return explained(options, made.plan, paint)


def _check(options: Namespace) -> None:
    """Refuse options that have nothing to do with each other. Raises `UsageError`."""
    if (options.explain or options.diff) and options.format not in _OF_ANSWERS:
        asked = "--explain" if options.explain else "--diff"
        raise UsageError(f"{asked} answers as text or json, not as {options.format}")
    if options.exit_code and not options.diff:
        raise UsageError("--exit-code goes with --diff")
    if options.host and options.format not in ("text", "sh"):
        raise UsageError(f"--host is for text; a plan as {options.format} is that of every machine")
    if options.portable and options.format == "sh":
        raise UsageError("a portable plan cannot be run: it has symbols where a script needs paths")
    if options.diff and not options.words:
        raise UsageError("a launch file is missing: --diff takes all words behind it, so it stands last")


def _compare(options: Namespace, made: Made, paint: colour.Paint) -> int:
    """Print what lies between the plan and the one behind `--diff`, whose problems point into its own words."""
    from argparse import Namespace  # noqa: PLC0415 - as above, and it is imported where there is a --diff

    from orchestra.cli.planning.comparison import compared  # noqa: PLC0415 - only this needs it

    try:
        text, different = compared(options, made, paint)
    except DescriptionError as error:
        words = [word for word in options.diff if ":=" in word] or options.words
        telling = boundary.Telling.of("plan", Namespace(**{**vars(options), "words": words}))
        given = telling.command_line
        boundary.show_problems(error.problems, telling.problem_format, sys.stderr, command_line=given)
        return boundary.MISTAKE
    give(text.encode(errors="surrogateescape"), "")
    return _DIFFERENT if different and options.exit_code else boundary.OK


def _shown(options: Namespace, made: Made, paint: colour.Paint) -> str:
    # What only some options need is imported for these.
    from orchestra.plan.render.formats import FORMATS as RENDERERS  # noqa: PLC0415
    from orchestra.plan.render.setting import Setting  # noqa: PLC0415

    plan, added = made.plan, None
    if options.node:
        from orchestra.cli.planning.choice import chosen  # noqa: PLC0415

        plan = chosen(plan, options.node)
    if options.portable or options.host or options.format == "sh":
        from orchestra.cli.planning import host  # noqa: PLC0415
        from orchestra.plan.portable import portable  # noqa: PLC0415

        plan = portable(plan, host.symbols(plan)) if options.portable else plan
        added = host.additions(made.files) if options.host or options.format == "sh" else None
    return RENDERERS[options.format](plan, Setting(paint, added))
