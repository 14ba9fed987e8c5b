"""`orchestra start`: start processes that have not begun or have ended."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.cli import changing

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.cli.parser import CommandParser


def parser() -> CommandParser:
    """Return what the command understands."""
    made = changing.parser(
        "start", "Start processes that have not begun or have ended.", waits="they run, and are ready"
    )
    changing.add_processes(made)
    return made


def run(options: Namespace) -> int:
    """Begin them now, whatever they wait for."""
    return changing.changed("start", options)
