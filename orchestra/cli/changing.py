"""What `start`, `stop`, `restart` and `signal` share: which processes, whether to wait, and what came of it."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from orchestra.cli import runs
from orchestra.cli.parser import CommandParser

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable

_EPILOG = """\
A process is named as 'orchestra ps' shows it; 'robot1/' is everything in that namespace, '*ekf' a pattern.
"""
_WELL = {
    "start": frozenset({"starting", "running", "ready", "exited"}),
    "stop": frozenset({"stopping", "exited", "failed", "skipped", "waiting", "restarting"}),
    "restart": frozenset({"stopping", "starting", "running", "ready", "exited"}),
}


def parser(command: str, description: str, *, waits: str | None) -> CommandParser:
    """Return what such a command understands; `waits` says what it waits for."""
    made = CommandParser(command, description, _EPILOG)
    runs.add_to(made)
    if waits:
        made.add_argument("--no-wait", action="store_true", help=f"do not wait until {waits}")
    made.add_argument("--format", choices=("text", "json"), default="text", help="default: text")
    return made


def add_processes(made: CommandParser) -> None:
    """Let the remaining words name processes."""
    made.add_argument("processes", nargs="+", metavar="PROCESS", help="a name, namespace/ or pattern")


def changed(command: str, options: Namespace) -> int:
    """Ask for it; return 0 where all processes stand as was wished, 1 where one does not."""
    with runs.connected(runs.living(options.run)) as client:
        answer = client.ask(command, processes=options.processes, wait=not options.no_wait)
        refused = [one for one in client.ask("snapshot")["processes"] if one["id"] in answer["refused"]]
    if options.format == "json":
        sys.stdout.write(runs.as_json(answer))
    else:
        _tell(answer, lambda process: process["phase"] + _remark(process))
    stand = [*answer["processes"].values(), *refused]
    return 0 if all(process["phase"] in _WELL[command] for process in stand) else 1


def signalled(options: Namespace) -> int:
    """Send the signal; return 0 where every process has got it."""
    with runs.connected(runs.living(options.run)) as client:
        answer = client.ask("signal", processes=options.processes, signal=options.signal)
    if options.format == "json":
        sys.stdout.write(runs.as_json(answer))
    else:
        _tell(answer, lambda process: f"signalled (pid {process['pid']})")
    return 1 if answer["refused"] else 0


def _tell(answer: dict[str, Any], words: Callable[[dict[str, Any]], str]) -> None:
    for process in answer["processes"].values():
        sys.stdout.write(f"{process['name']}: {words(process)}\n")
    for name, why in answer["refused"].items():
        runs.told(f"{name.removeprefix('/')}: {why}")


def _remark(process: dict[str, Any]) -> str:
    if process["phase"] in ("exited", "failed", "restarting") and process["ending"]:
        return f" ({process['ending']})"
    return f" (pid {process['pid']})" if process["pid"] else ""
