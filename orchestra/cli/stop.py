"""`orchestra stop`: end processes; the run goes on, and they can be started again."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.cli import changing

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.cli.parser import CommandParser


def parser() -> CommandParser:
    """Return what the command understands."""
    made = changing.parser(
        "stop", "End processes; the run goes on, and they can be started again.", waits="they have ended"
    )
    changing.add_processes(made)
    return made


def run(options: Namespace) -> int:
    """End them."""
    return changing.changed("stop", options)
