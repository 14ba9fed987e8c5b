"""`orchestra signal`: send a signal to processes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.cli import changing

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.cli.parser import CommandParser


def parser() -> CommandParser:
    """Return what the command understands."""
    made = changing.parser("signal", "Send a signal to processes.", waits=None)
    made.add_argument("signal", metavar="SIGNAL", help="its name or number: SIGUSR1, usr1, 10")
    changing.add_processes(made)
    return made


def run(options: Namespace) -> int:
    """Send it."""
    return changing.signalled(options)
