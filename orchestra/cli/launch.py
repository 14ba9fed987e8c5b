"""`orchestra launch`: start what a launch file describes, watch it, stop it."""

from __future__ import annotations

import os
import sys
from contextlib import ExitStack, nullcontext
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from orchestra.cli import boundary, inputs, run_options
from orchestra.cli.plain import plain
from orchestra.cli.problems.formats import FORMATS
from orchestra.cli.remembered import NO_CACHE

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable, Sequence
    from typing import BinaryIO

    from orchestra.cli.parser import CommandParser
    from orchestra.pipeline import Launch
    from orchestra.supervise.resolver.serving import Answer, Settled


def parser() -> CommandParser:
    """Return what the command understands."""
    # Slow, and of no use where there are no options.
    from orchestra.cli.parser import CommandParser  # noqa: PLC0415

    made = CommandParser("launch", "Start what a launch file describes, watch it, stop it.", inputs.EPILOG)
    _add_to(made)
    return made


def read(words: Sequence[str]) -> Any:  # noqa: ANN401 - what argparse makes of them
    """Return the options that words are. Raises `UsageError`, or `SystemExit` after `--help`."""
    return plain(words, _add_to) or parser().read(words)


def _add_to(made: Any) -> None:  # noqa: ANN401 - argparse's parser, or what stands for it
    inputs.add_to(made)
    made.add_argument(
        "--format",
        choices=FORMATS,
        default="text",
        help="how problems are shown (default: text)",
    )
    run_options.add_to(made)
    made.add_argument(
        NO_CACHE,
        action="store_true",
        help="read the launch file, also where nothing has changed since last time",
    )
    showing = made.add_mutually_exclusive_group()
    showing.add_argument(
        *("-s", "--show-args", "--show-arguments"),
        dest="show_args",
        action="store_true",
        help="show the arguments of the launch file and start nothing",
    )
    showing.add_argument(
        *("-p", "--print", "--print-description"),
        dest="print_plan",
        action="store_true",
        help="show the plan and start nothing",
    )


def run(options: Namespace) -> int:
    """Show what was asked for, else run the plan."""
    # What each of the three needs is heavy, and `--help` and the other two do not need it.
    if options.show_args:
        from orchestra.cli.arguments import show_arguments  # noqa: PLC0415
        from orchestra.cli.heeding import heeded  # noqa: PLC0415

        with heeded():
            return show_arguments(options)
    if options.print_plan:
        from orchestra.cli.heeding import heeded  # noqa: PLC0415
        from orchestra.plan.render.formats import FORMATS as PLAN_FORMATS  # noqa: PLC0415

        with heeded():
            plan = inputs.plan_from(options, launching=False)
        inputs.warn(plan, options)
        sys.stdout.write(PLAN_FORMATS["text"](plan))
        return boundary.OK
    from orchestra.cli.handover import supervised  # noqa: PLC0415

    return supervised("launch", prepare, options)


def prepare(options: Namespace, stream: BinaryIO, words: Sequence[str] = ()) -> int | Answer | Settled:
    """Make the plan and hand it to the supervisor; its warnings go to standard error.

    Where code of the launch files decides about something in the run, what is returned asks it. `words` are those of
    the command line: what they come to is kept for the next time, where there are some.
    """
    # All of it is heavy, and only a run needs it.
    from orchestra import pipeline  # noqa: F401, PLC0415 - before it is watched what is read
    from orchestra.cli.handover import document_of, warnings_of  # noqa: PLC0415
    from orchestra.cli.remembering import memory  # noqa: PLC0415
    from orchestra.resolve.python.files import Files  # noqa: PLC0415
    from orchestra.supervise.keeping.marks import RUN, folder_prefix  # noqa: PLC0415
    from orchestra.supervise.resolver.serving import Settled  # noqa: PLC0415

    if run := os.environ.get(RUN):
        Files.prefix = folder_prefix(run)  # by which the supervisor finds it that has killed this process
    kept = memory(words) if words else None
    postponed: list[Callable[[], None]] = []
    with ExitStack() as lasting:
        with kept.watching() if kept else nullcontext():
            launch = inputs.launch_from(options, lasting, postponed)
            told = warnings_of(launch.plan, options)
            name = Path(launch.plan.file).name.partition(".")[0]
            files = launch.files.keep(more=launch.deferred)
            document = document_of(launch.plan, options, name, files=files)
        boundary.tell(told)
        stream.write(document)
        if launch.deferred:
            return partial(_answer, lasting.pop_all(), launch)
        # Whether limits can be granted is another question each time, and files are another folder.
        lasts = files is None and all(process.limits is None for process in launch.plan.processes)
        keep = kept.keep(document, told) if kept and lasts else None
    if keep:
        postponed.append(keep)
    return Settled(partial(_carry_out, postponed)) if postponed else boundary.OK


def _carry_out(postponed: Sequence[Callable[[], None]]) -> None:
    for call in postponed:
        call()


def _answer(lasting: ExitStack, launch: Launch, question: dict[str, Any]) -> dict[str, Any]:
    """Ask code of the launch files, which can be called as long as somebody holds `lasting`."""
    del lasting
    return launch.answer(question)
