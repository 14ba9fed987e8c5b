"""`orchestra ps`: which runs are alive, and how their processes stand."""

from __future__ import annotations

import os
import sys
import time
from typing import TYPE_CHECKING, Any

from orchestra.cli import colour, runs, table
from orchestra.cli.parser import CommandParser
from orchestra.cli.usage import usage
from orchestra.errors import RunError
from orchestra.supervise.runs import registry

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.supervise.runs.registry import Run

_HEAD = ("NAME", "STATE", "PID", "RESTARTS", "UPTIME", "CPU", "MEMORY", "")
_STATE, _NOTE = 1, 7
# ECMA-48 colours by phase: well, on its way, ended badly, of no matter.
_COLOURS = {
    "ready": "32",
    "running": "32",
    "starting": "33",
    "stopping": "33",
    "restarting": "33",
    "waiting": "36",
    "failed": "31",
    "skipped": "2",
    "exited": "2",
}


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser("ps", "Show which runs are alive, and how their processes stand.")
    made.add_argument("--run", metavar="RUN", help="only the run of this name (default: all that are alive)")
    made.add_argument("--format", choices=("table", "json"), default="table", help="default: table")
    return made


def run(options: Namespace) -> int:
    """Show them. A run that does not answer is told, and makes the status 1."""
    chosen = [runs.living(options.run)] if options.run else registry.living(runs.folder())
    seen = []
    silent = 0
    for one in chosen:
        try:
            seen.append(_seen(one))
        except RunError as error:
            silent += 1
            runs.told(f"error: {error}")
    if options.format == "json":
        sys.stdout.write(runs.as_json(seen))
    elif seen:
        sys.stdout.write("\n".join(map(_shown, seen)))
    elif not silent:
        runs.told("no run is alive")
    return 1 if silent else 0


def _seen(one: Run) -> dict[str, Any]:
    """Return what is known of a run: with `cpu` as the share of one core since the begin, and `memory` in bytes."""
    with runs.connected(one) as client:
        processes = client.ask("snapshot")["processes"]
    used = usage(process["pid"] for process in processes if process["pid"])
    for process in processes:
        own = used.get(process["pid"])
        age = process["uptime"]
        process["memory"] = own.memory if own else None
        process["cpu"] = round(own.cpu / age, 4) if own and age else None
    return {
        "name": one.name,
        "file": one.identity.file,
        "directory": str(one.directory),
        "run": one.identity.run,
        "keeper": one.identity.keeper,
        "supervisor": one.identity.supervisor,
        "age": round(max(0.0, time.time() - one.identity.began), 3),
        "processes": processes,
    }


def _shown(seen: dict[str, Any]) -> str:
    enabled = colour.wanted(sys.stdout, os.environ)
    paint = colour.painter(enabled=enabled)
    processes = seen["processes"]

    def painted(row: int, column: int, text: str) -> str:
        if not enabled or (row and column not in (_STATE, _NOTE)):
            return text
        if not row:
            return paint("faint", text)
        style = _COLOURS.get(processes[row - 1]["phase"], "0") if column == _STATE else "2"
        return f"\x1b[{style}m{text}\x1b[0m"

    head = f"{paint('strong', seen['name'])}  {seen['file']}  up {table.duration(seen['age'])}\n"
    return head + table.aligned([_HEAD, *map(_row, processes)], painted, indent="  ")


def _row(process: dict[str, Any]) -> tuple[str, ...]:
    cpu = process["cpu"]
    return (
        process["name"],
        process["phase"],
        str(process["pid"] or "-"),
        str(max(0, process["starts"] - 1)),
        table.duration(process["uptime"]),
        "-" if cpu is None else f"{cpu:.1%}",
        table.size(process["memory"]),
        _note(process),
    )


def _note(process: dict[str, Any]) -> str:
    """Say what a process waits for, or how its latest run ended where that is news."""
    if process["awaited"]:
        return f"waits for {process['awaited']}"
    restarted = process["phase"] in ("ready", "running") and process["starts"] > 1
    return f"before: {process['ending']}" if restarted and process["ending"] else process["ending"] or ""
