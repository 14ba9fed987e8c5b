"""Opens what a run needs around it, and closes it at the end: log files, screens, the event stream."""

from __future__ import annotations

import os
from contextlib import ExitStack, contextmanager
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

from orchestra.logs.screen import Screen, same_file
from orchestra.logs.sheets import Sheet, Sheets
from orchestra.logs.terminal_text import wants_colour
from orchestra.supervise.environment import common_environment, described
from orchestra.supervise.graph.discovery import quick_discovery
from orchestra.supervise.graph.observation import Observers
from orchestra.supervise.libraries import host_of_run
from orchestra.supervise.output.books import books
from orchestra.supervise.output.console import Console
from orchestra.supervise.reactions.questions import Questions
from orchestra.supervise.signs.trial import Trials
from orchestra.supervise.surroundings import Surroundings

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from orchestra.plan.model import Plan, Process
    from orchestra.supervise.beginnings import Beginnings
    from orchestra.supervise.keeping.kin import Kin
    from orchestra.supervise.limits.confines import Confines
    from orchestra.supervise.loop import Loop
    from orchestra.supervise.options import RunOptions
    from orchestra.supervise.resolver.process import Resolver
    from orchestra.supervise.runs.directory import RunDirectory
    from orchestra.supervise.service_manager import ServiceManager
    from orchestra.supervise.warm.starts import Starts

_STDOUT, _STDERR = 1, 2
# A screen that takes nothing for so long gets no more, in seconds.
_SCREEN_PATIENCE = 0.5


class Before(NamedTuple):
    """What is at work before there is a run directory."""

    kin: Kin
    confines: Confines
    service: ServiceManager
    starts: Starts


@contextmanager
def surroundings(
    loop: Loop,
    run_directory: RunDirectory,
    plan: Plan,
    options: RunOptions,
    *,
    beginnings: Beginnings,
    resolver: Resolver | None,
    before: Before,
) -> Iterator[Surroundings]:
    """Open everything for a run; `resolver` is the one that stays for it."""
    run_id = beginnings.run_id
    with ExitStack() as opened:
        opened.callback(before.confines.close)
        sheets = opened.enter_context(_screens(loop, options))
        written = opened.enter_context(books(loop, run_directory, plan, options, sheets))
        journal = written.journal
        console = Console(loop, os.getppid(), detached=options.detached)
        opened.callback(console.close)
        kin, before.starts.said = before.kin, journal.say
        yield Surroundings(
            loop=loop,
            kin=kin,
            journal=journal,
            recorder=written.recorder,
            intake=written.intake,
            console=console,
            observers=Observers(loop, kin, lambda text: journal.say(f"observer: {text.rstrip()}")),
            trials=Trials(loop, kin),
            service=before.service,
            starts=before.starts,
            questions=Questions(resolver, loop, kin, options.resolver_timeout),
            confines=before.confines,
            environment=_environment(run_directory, run_id, colour=sheets.output.colour),
            folder=run_directory.path,
            options=options,
            more_time=beginnings.more_time,
        )


def _environment(
    run_directory: RunDirectory, run_id: str, *, colour: bool
) -> Callable[[Process | None], dict[str, str]]:
    host, ros_logs = host_of_run(), str(run_directory.logs / "ros")
    caller = {**os.environ, **quick_discovery(os.environ, run_directory.path)}

    @cache
    def common(*, inherit: bool) -> dict[str, str]:
        return common_environment(caller, host, log_folder=ros_logs, colour=colour, inherit=inherit)

    def environment(process: Process | None) -> dict[str, str]:
        if process is None:
            return described(common(inherit=True), {}, (run_id, ""))
        return described(
            common(inherit=process.inherit_environment), process.environment, (run_id, process.id)
        )

    return environment


@contextmanager
def _screens(loop: Loop, options: RunOptions) -> Iterator[Sheets]:
    """Open standard output for processes and standard error for ourselves; one sheet where both are the same."""
    with ExitStack() as opened:
        output = opened.enter_context(_sheet(loop, _STDOUT, options))
        if same_file(_STDOUT, _STDERR):
            yield Sheets(output, output)
        else:
            yield Sheets(output, opened.enter_context(_sheet(loop, _STDERR, options)))


@contextmanager
def _sheet(loop: Loop, descriptor: int, options: RunOptions) -> Iterator[Sheet]:
    colour = wants_colour(asked=options.colour, terminal=os.isatty(descriptor), environment=dict(os.environ))

    def watch(wanted: bool) -> None:
        if wanted:
            loop.on_writable(screen.descriptor, screen.writable)
        else:
            loop.forget(screen.descriptor)

    screen = Screen(descriptor, watch)
    try:
        yield Sheet(screen, colour=colour)
    finally:
        screen.finish(_SCREEN_PATIENCE)
        screen.close()
