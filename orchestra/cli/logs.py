"""`orchestra logs`: what the processes of a run have written, and what they write."""

from __future__ import annotations

import os
import re
import sys
from itertools import islice
from typing import TYPE_CHECKING

from orchestra.cli import colour, past, runs
from orchestra.cli.following import looks
from orchestra.cli.parser import CommandParser
from orchestra.dataclass import dataclass
from orchestra.errors import RunError, UsageError
from orchestra.logs import records
from orchestra.logs.names import shown
from orchestra.logs.pieces import Follower

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from orchestra.logs.records import Record

_OURSELVES = "orchestra"
_EPILOG = """\
A process is named as 'orchestra ps' shows it; 'robot1/' is everything in that namespace, '*ekf' a pattern, and
'orchestra' is Orchestra itself. Lines without a severity count as info.
"""
_SEVERITY_COLOURS = {"debug": "2", "warn": "33", "error": "31", "fatal": "1;31"}


@dataclass(frozen=True, slots=True)
class Filter:
    """Which records are wanted; None is no condition. `processes` has the ids, and `orchestra` for our own lines."""

    processes: frozenset[str] | None
    since: float | None
    level: int
    pattern: re.Pattern[str] | None

    def wants(self, record: Record) -> bool:
        """Tell whether a record is wanted."""
        return (
            (self.processes is None or (record.process or _OURSELVES) in self.processes)
            and (self.since is None or record.time >= self.since)
            and records.SEVERITIES.index(record.severity or "info") >= self.level
            and (self.pattern is None or self.pattern.search(record.text) is not None)
        )


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser("logs", "Show what the processes of a run have written.", _EPILOG)
    made.add_argument(
        "--run",
        metavar="RUN",
        help="the name of the run, or its directory (default: the one that is alive or was last)",
    )
    made.add_argument("-f", "--follow", action="store_true", help="go on until the run is over")
    made.add_argument("-n", "--lines", type=int, metavar="LINES", help="begin with so many of the last lines")
    made.add_argument(
        "--since", metavar="TIME", help="only what is not older: 10s, 5m, 2h, 1d, 2026-08-21T10:30:00"
    )
    made.add_argument(
        "--level", choices=records.SEVERITIES, default="debug", help="only this severity and graver ones"
    )
    made.add_argument("--grep", metavar="REGEX", help="only lines in which this is found")
    made.add_argument("--format", choices=("text", "json"), default="text", help="json: one record per line")
    made.add_argument("processes", nargs="*", metavar="PROCESS", help="only these (default: all)")
    return made


def run(options: Namespace) -> int:
    """Show them."""
    directory = runs.recorded(options.run)
    log = directory / "logs" / "all.jsonl"
    if not log.parent.is_dir():
        raise RunError(f"there are no logs in {directory}")
    wanted = _filter(options, directory)
    write = _writer(options.format, directory)
    follower = Follower(log, from_now=options.lines is not None)
    last = islice(filter(wanted.wants, records.parsed(follower.before())), options.lines or 0)
    for record in reversed(list(last)):
        write(record)
    for _ in looks(directory, log.parent, follow=options.follow):
        for record in _wanted(follower, wanted):
            write(record)
        sys.stdout.flush()
    follower.close()
    return 0


def _filter(options: Namespace, directory: Path) -> Filter:
    if options.lines is not None and options.lines < 0:
        raise UsageError("--lines is a number of lines, 0 or more")
    try:
        pattern = re.compile(options.grep) if options.grep is not None else None
    except re.error as error:
        raise UsageError(f"--grep is no regular expression: {error}") from error
    return Filter(
        past.selected(options.processes, directory, _OURSELVES),
        past.since(options.since) if options.since else None,
        records.SEVERITIES.index(options.level),
        pattern,
    )


def _wanted(follower: Follower, wanted: Filter) -> Iterator[Record]:
    """Yield what is wanted of what has been written since the last time."""
    while lines := follower.lines():
        yield from filter(wanted.wants, records.parsed(iter(lines)))


def _writer(form: str, directory: Path) -> Callable[[Record], None]:
    if form == "json":
        return lambda record: _write(records.dumps(record))
    enabled = colour.wanted(sys.stdout, os.environ)
    width = min(32, max(map(len, map(shown, past.processes(directory))), default=0))

    def write(record: Record) -> None:
        name = f"[{shown(record.process) if record.process else _OURSELVES}]".ljust(width + 2)
        line = f"{past.clock(record.time)} {name} {record.text}"
        style = _SEVERITY_COLOURS.get(record.severity or "") if enabled else None
        _write(f"\x1b[{style}m{line}\x1b[0m" if style else line)

    return write


def _write(line: str) -> None:
    """Write a line; what was no UTF-8 when the process wrote it is the same bytes again."""
    sys.stdout.buffer.write(line.encode("utf-8", "surrogateescape") + b"\n")
