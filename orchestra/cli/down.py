"""`orchestra down`: end a run, and tell how it ended."""

from __future__ import annotations

import os
import select
import sys
from typing import TYPE_CHECKING, Any

from orchestra.cli import runs
from orchestra.cli.parser import CommandParser
from orchestra.errors import RunError
from orchestra.supervise.runs import registry

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.control.client import Client
    from orchestra.supervise.runs.registry import Run

_EPILOG = "The exit status is that of the run; with --all it is the first that is not 0."


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser("down", "End a run in order, and tell how it ended.", _EPILOG)
    which = made.add_mutually_exclusive_group()
    runs.add_to(which)  # type: ignore[arg-type] # a group of argparse has what it needs of a parser
    which.add_argument("--all", action="store_true", help="every run that is alive")
    made.add_argument("--no-wait", action="store_true", help="do not wait until it has ended")
    return made


def run(options: Namespace) -> int:
    """End it."""
    chosen = registry.living(runs.folder()) if options.all else [runs.living(options.run)]
    if not chosen:
        raise RunError("no run is alive")
    statuses = [_ended(one, wait=not options.no_wait) for one in chosen]
    return next(filter(None, statuses), 0)


def _ended(one: Run, *, wait: bool) -> int:
    with runs.connected(one) as client:
        # Held from before the end, so that the number cannot be another's.
        keeper = os.pidfd_open(one.identity.keeper)
        try:
            client.ask("subscribe")
            client.ask("down")
            if not wait:
                return 0
            last = _last_event(client)
            _await(keeper)
        finally:
            os.close(keeper)
    if last is None:
        raise RunError(f"{one.name}: its supervisor ended without a word; see {one.directory}")
    sys.stdout.write(f"{one.name} ended with status {last['status']}: {last['reason']}\n")
    return int(last["status"])


def _last_event(client: Client) -> dict[str, Any] | None:
    """Wait for the event that tells how the run ended; None where it hangs up without one."""
    for message in client.messages():
        event = message.get("event", {})
        if event.get("kind") == "run_ended":
            data: dict[str, Any] = event["data"]
            return data
    return None


def _await(process: int) -> None:
    """Wait for the end of a process by its pidfd (pidfd_open(2))."""
    poll = select.poll()
    poll.register(process, select.POLLIN)
    poll.poll()
