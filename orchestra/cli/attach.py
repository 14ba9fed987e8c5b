"""`orchestra attach`: see what a process writes, and type what it reads."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

from orchestra.cli import runs
from orchestra.cli.parser import CommandParser

if TYPE_CHECKING:
    from argparse import Namespace

_EPILOG = """\
Ctrl-P Ctrl-Q leaves, and so does '~.' at the begin of a line; the process goes on. One that has no terminal of its own
reads nothing: its output can be followed, and Ctrl-C leaves.
"""


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser("attach", "See what a process writes, and type what it reads.", _EPILOG)
    runs.add_to(made)
    made.add_argument("--no-input", action="store_true", help="only look")
    made.add_argument("process", metavar="PROCESS", help="its name, as 'orchestra ps' shows it")
    return made


def run(options: Namespace) -> int:
    """Attach until the user leaves or the process has ended for good."""
    from orchestra.cli.conversation import Conversation  # noqa: PLC0415 - base64 and termios, which `--help` needs not

    with runs.connected(runs.living(options.run)) as client:
        size = {}
        if sys.stdout.isatty():
            columns, lines = os.get_terminal_size(sys.stdout.fileno())
            size = {"columns": max(1, columns), "lines": max(1, lines)}
        answer = client.ask("attach", process=options.process, **size)
        types = bool(answer["takes_input"]) and not options.no_input and sys.stdin is not None
        return Conversation(client, types=types).hold()
