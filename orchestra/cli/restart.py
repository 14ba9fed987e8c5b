"""`orchestra restart`: end processes and start them anew."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.cli import changing

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.cli.parser import CommandParser


def parser() -> CommandParser:
    """Return what the command understands."""
    made = changing.parser(
        "restart", "End processes and start them anew.", waits="they run again, and are ready"
    )
    changing.add_processes(made)
    return made


def run(options: Namespace) -> int:
    """End them and start them anew."""
    return changing.changed("restart", options)
