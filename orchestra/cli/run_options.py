"""The options that say how a run is carried out, which `launch` and `run` share."""

from __future__ import annotations

import os
import re
import sys
from typing import TYPE_CHECKING

from orchestra.cli import log_options
from orchestra.errors import UsageError
from orchestra.logs.outputs import OVERRIDE, forced_output
from orchestra.supervise.options import RunOptions

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace


def add_to(parser: ArgumentParser) -> None:
    """Let a parser read them."""
    parser.add_argument(
        "--name", metavar="RUN", help="a name that no living run has (default: made of the file's)"
    )
    parser.add_argument(
        "--detach", action="store_true", help="return as soon as the run has begun; 'orchestra down' ends it"
    )
    parser.add_argument(
        "--wait-ready", action="store_true", help="with --detach: return when everything is ready"
    )
    parser.add_argument(
        "--fail-on",
        choices=("required", "any"),
        default="required",
        help="whose failure makes the run fail (default: required)",
    )
    parser.add_argument(
        *("-a", "--show-all-subprocesses-output"),
        dest="show_all",
        action="store_true",
        help=f"show the output of every process, as {OVERRIDE}=both",
    )
    parser.add_argument(
        *("-d", "--debug"),
        action="store_true",
        help="show messages of level debug too, and the traceback of a bug in Orchestra",
    )
    parser.add_argument(
        *("-n", "--noninteractive"),
        action="store_true",
        help="take no terminal for granted (default where standard input is none)",
    )
    parser.add_argument(
        "--no-warm",
        action="store_true",
        help="start each node by itself, not as a fork of a process that has its imports already",
    )
    log_options.add_to(parser)


def run_options(options: Namespace, default_name: str) -> RunOptions:
    """Return how to run; a name becomes one that any file system takes.

    Raises `UsageError` for options that do not fit, and where the environment asks for an output that there is not.
    """
    if options.wait_ready and not options.detach:
        raise UsageError("--wait-ready goes with --detach")
    name = re.sub(r"[^\w.-]+", "_", options.name or default_name).strip("._")
    try:
        forced_output(os.environ, show_all=options.show_all)
    except ValueError as error:
        raise UsageError(f"{OVERRIDE}: {error}") from error
    log_size, log_keep = log_options.log_limits(options, os.environ)
    return RunOptions(
        name=name or "run",
        named=bool(options.name and name),
        detached=options.detach,
        fail_on_any=options.fail_on == "any",
        show_all_output=options.show_all,
        noninteractive=options.noninteractive or not _at_a_terminal(),
        debug=options.debug,
        warm=not options.no_warm,
        log_size=log_size,
        log_keep=log_keep,
    )


def _at_a_terminal() -> bool:
    return sys.stdin is not None and sys.stdin.isatty()
