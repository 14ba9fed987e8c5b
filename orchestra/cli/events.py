"""`orchestra events`: what has happened in a run, and what happens."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING

from orchestra import events
from orchestra.cli import past, runs
from orchestra.cli.following import looks
from orchestra.cli.parser import CommandParser
from orchestra.errors import RunError
from orchestra.logs.names import shown
from orchestra.logs.pieces import Follower

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Iterator

    from orchestra.events import Event


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser("events", "Show what has happened in a run.")
    made.add_argument(
        "--run",
        metavar="RUN",
        help="the name of the run, or its directory (default: the one that is alive or was last)",
    )
    made.add_argument("-f", "--follow", action="store_true", help="go on until the run is over")
    made.add_argument(
        "--since", metavar="TIME", help="only what is not older: 10s, 5m, 2h, 1d, 2026-08-21T10:30:00"
    )
    made.add_argument("--format", choices=("text", "json"), default="text", help="json: one event per line")
    made.add_argument("processes", nargs="*", metavar="PROCESS", help="only of these (default: all)")
    return made


def run(options: Namespace) -> int:
    """Show them."""
    directory = runs.recorded(options.run)
    stream = directory / "events.jsonl"
    if not stream.is_file():
        raise RunError(f"there are no events in {directory}")
    since = past.since(options.since) if options.since else 0.0
    selected = past.selected(options.processes, directory)
    follower = Follower(stream)
    for _ in looks(directory, directory, follow=options.follow):
        for event in _new(follower):
            if event.time >= since and (selected is None or event.process in selected):
                _write(event, options.format)
        sys.stdout.flush()
    follower.close()
    return 0


def _new(follower: Follower) -> Iterator[Event]:
    """Yield the events since the last time."""
    while lines := follower.lines():
        for line in lines:
            try:
                yield events.loads(line)
            except ValueError:
                continue  # the disk was full in the middle of it


def _write(event: Event, form: str) -> None:
    """Write an event in a line; lone surrogates, which stand for other bytes than UTF-8, become these again."""
    line = events.dumps(event) if form == "json" else _told(event)
    sys.stdout.buffer.write(line.encode("utf-8", "surrogateescape") + b"\n")


def _told(event: Event) -> str:
    about = [shown(event.process)] if event.process else []
    pid = [f"pid={event.pid}"] if event.pid is not None else []
    cause = [f"cause={event.cause}"] if event.cause else []
    facts = [f"{name}={_value(value)}" for name, value in event.data.items() if value is not None]
    return " ".join([past.clock(event.time), event.kind, *about, *pid, *cause, *facts])


def _value(value: object) -> str:
    """Return a value of an event's data in a word, or in quotes."""
    text = value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
    return text if text and " " not in text and "\n" not in text else json.dumps(text, ensure_ascii=False)
