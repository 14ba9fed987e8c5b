"""The options that say how a run is carried out, which `launch` and `run` share."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from orchestra.errors import UsageError
from orchestra.supervise.options import RunOptions

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Mapping

OVERRIDE_OUTPUT = "OVERRIDE_LAUNCH_PROCESS_OUTPUT"
_OUTPUTS = ("log", "screen", "both", "own_log", "full")


def add_to(parser: ArgumentParser) -> None:
    """Let a parser read them."""
    parser.add_argument("--name", metavar="RUN", help="a name for the run directory (default: from the file)")
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
        help=f"show the output of every process, as {OVERRIDE_OUTPUT}=both",
    )
    parser.add_argument("-d", "--debug", action="store_true", help="show the traceback of a bug in Orchestra")
    parser.add_argument(
        *("-n", "--noninteractive"),
        action="store_true",
        help="take no terminal for granted (default where standard input is none)",
    )


def run_options(options: Namespace, default_name: str) -> RunOptions:
    """Return how to run; a name becomes one that any file system takes."""
    name = re.sub(r"[^\w.-]+", "_", options.name or default_name).strip("._")
    return RunOptions(name=name or "run", fail_on_any=options.fail_on == "any")


def output_override(options: Namespace, environment: Mapping[str, str]) -> str | None:
    """Return the `output` that every process has instead of its own (upstream: `ExecuteLocal`), None for its own.

    Raises `UsageError` where the variable holds no such word.
    """
    if options.show_all:
        return "both"
    word = environment.get(OVERRIDE_OUTPUT, "")
    if word and word not in _OUTPUTS:
        raise UsageError(f"{OVERRIDE_OUTPUT} is '{word}', which is none of {', '.join(_OUTPUTS)}")
    return word or None
