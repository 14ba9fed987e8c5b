"""From the words of the command line to a command."""

from __future__ import annotations

import sys
from importlib import import_module
from typing import TYPE_CHECKING, TypeVar

from orchestra.cli.boundary import Telling, guarded
from orchestra.cli.commands import ALIASES, COMMANDS, overview
from orchestra.cli.leaving import end_at_once, threads
from orchestra.errors import UsageError
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Callable, Sequence
    from typing import Any, BinaryIO

    from orchestra.supervise.resolver.serving import Answer, Settled

_ResultT = TypeVar("_ResultT")


def main(words: Sequence[str], *, heeding: bool = False) -> int:
    """Carry out the command line, without the program's name, and return the exit status.

    With `heeding` SIGTERM and SIGHUP end the command as Ctrl-C does: nothing that it starts is to stay.
    """
    name = words[0] if words else ""
    before = threads()
    status = guarded(lambda: _dispatch(words, heeding=heeding), Telling(name if name in COMMANDS else ""))
    if threads() - before:
        end_at_once(status)
    return status


def prepare(words: Sequence[str], stream: BinaryIO) -> int | Answer | Settled:
    """Write the plan of `launch` or `run` to the stream; return 0, or the status of the error that was shown.

    This is what the resolver process of a run does.
    """

    def act(module: Any, options: Namespace) -> int | Answer | Settled:  # noqa: ANN401 - the module of a command
        prepared: int | Answer | Settled = module.prepare(options, stream, words)
        return prepared

    return guarded(lambda: _carry_out(words[0], words[1:], act), Telling(words[0]))


def _carry_out(name: str, words: Sequence[str], act: Callable[[Any, Namespace], _ResultT]) -> _ResultT | int:
    """Read the options of a command and act on them with its module, the only one of a command that is imported."""
    module = import_module(COMMANDS[name].module)
    try:
        read = getattr(module, "read", None) or module.parser().read
        options = read(words)
    except SystemExit:  # argparse leaves so after it has printed the help
        return 0
    return guarded(lambda: act(module, options), Telling.of(name, options))


def _dispatch(words: Sequence[str], *, heeding: bool) -> int:
    if not words:
        raise UsageError("a command is missing")
    name, *rest = words
    name = ALIASES.get(name, name)
    if name in ("-h", "--help", "help"):
        sys.stdout.write(overview())
        return 0
    if name == "--version":
        from orchestra.cli.version import version  # noqa: PLC0415 - only here

        sys.stdout.write(f"orchestra {version()}\n")
        return 0
    if name not in COMMANDS:
        near = nearest(name, COMMANDS)
        raise UsageError(f"there is no command '{name}'" + (f"; did you mean '{near}'?" if near else ""))
    if name == "plan" and _again(rest):
        return 0
    return _carry_out(name, rest, _heed if heeding else _run)


def _run(module: Any, options: Namespace) -> int:  # noqa: ANN401 - the module of a command
    return int(module.run(options))


def _heed(module: Any, options: Namespace) -> int:  # noqa: ANN401 - as above
    from orchestra.cli.heeding import heeded  # noqa: PLC0415 - other commands do not need it

    with heeded():
        return _run(module, options)


def _again(words: Sequence[str]) -> bool:
    """Answer as before, if it is known that nothing has changed since."""
    from orchestra.cli.answered import again  # noqa: PLC0415 - only this needs it

    return again(words)
