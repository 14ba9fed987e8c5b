"""A command that processes are run with, given on the command line: short for two launch arguments, as upstream."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import UsageError

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace


def add_to(parser: ArgumentParser) -> None:
    """Let a parser read it."""
    parser.add_argument(
        "--launch-prefix", metavar="COMMAND", help="run every process with a command: 'gdb -ex run --args'"
    )
    parser.add_argument(
        "--launch-prefix-filter",
        metavar="REGEX",
        help="only those with an executable whose name begins so; wants --launch-prefix",
    )


def check(options: Namespace) -> None:
    """Raise `UsageError` where the filter has nothing to choose for."""
    if options.launch_prefix_filter is not None and options.launch_prefix is None:
        raise UsageError("--launch-prefix-filter wants --launch-prefix too")


def words(options: Namespace) -> tuple[str, ...]:
    """Return the launch arguments; they come after those that are written out, and so win."""
    given = {
        "launch-prefix": getattr(options, "launch_prefix", None),
        "launch-prefix-filter": getattr(options, "launch_prefix_filter", None),
    }
    return tuple(f"{name}:={value}" for name, value in given.items() if value is not None)
