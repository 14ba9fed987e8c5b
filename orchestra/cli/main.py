"""From the words of the command line to a command."""

from __future__ import annotations

import sys
from importlib import import_module
from importlib.metadata import version
from typing import TYPE_CHECKING

from orchestra.cli.boundary import guarded
from orchestra.cli.commands import COMMANDS, Command, overview
from orchestra.errors import UsageError
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Sequence


def main(words: Sequence[str]) -> int:
    """Carry out the command line, without the program's name, and return the exit status."""
    name = words[0] if words else ""
    return guarded(lambda: _carry_out(words), command=name if name in COMMANDS else "")


def _carry_out(words: Sequence[str]) -> int:
    if not words:
        raise UsageError("a command is missing")
    name, *rest = words
    if name in ("-h", "--help", "help"):
        sys.stdout.write(overview())
        return 0
    if name == "--version":
        sys.stdout.write(f"orchestra {version('orchestra')}\n")
        return 0
    return _run(name, _command(name), rest)


def _command(name: str) -> Command:
    if name in COMMANDS:
        return COMMANDS[name]
    near = nearest(name, COMMANDS)
    raise UsageError(f"there is no command '{name}'" + (f"; did you mean '{near}'?" if near else ""))


def _run(name: str, command: Command, words: Sequence[str]) -> int:
    """Run a command; only the module of this one is imported."""
    module = import_module(command.module)
    try:
        options = module.parser().read(words)
    except SystemExit:  # argparse leaves so after it has printed the help
        return 0
    problem_format = getattr(options, "problem_format", "text")
    return guarded(lambda: int(module.run(options)), command=name, problem_format=problem_format)
