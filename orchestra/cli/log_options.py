"""The options that say how much of the output of a run is kept."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import UsageError

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Mapping

SIZE_VARIABLE = "ORCHESTRA_LOG_SIZE"
KEEP_VARIABLE = "ORCHESTRA_LOG_KEEP"
_SIZE = "64M"
_KEEP = "7"


def add_to(parser: ArgumentParser) -> None:
    """Let a parser read them."""
    parser.add_argument(
        "--log-size",
        metavar="SIZE",
        help=f"put each log file away when it is so large, 0: never (default: {SIZE_VARIABLE}, else {_SIZE})",
    )
    parser.add_argument(
        "--log-keep",
        metavar="N",
        help=f"how many older pieces of each log file stay (default: {KEEP_VARIABLE}, else {_KEEP})",
    )


def log_limits(options: Namespace, environment: Mapping[str, str]) -> tuple[int, int]:
    """Return the size of a log file in bytes, and how many older ones are kept. Raises `UsageError`."""
    # Whoever gives the options reads a launch file, for which all this is loaded; the parser itself is not to wait.
    from orchestra.resolve.amounts import UnfitError  # noqa: PLC0415
    from orchestra.resolve.quantities import size  # noqa: PLC0415

    text, source = _first(
        (options.log_size, "--log-size"), (environment.get(SIZE_VARIABLE), SIZE_VARIABLE), _SIZE
    )
    try:
        limit = size(text)
    except UnfitError as error:
        raise UsageError(f"{source}: {error}") from error
    text, source = _first(
        (options.log_keep, "--log-keep"), (environment.get(KEEP_VARIABLE), KEEP_VARIABLE), _KEEP
    )
    if not (text.isascii() and text.isdecimal()):
        raise UsageError(f"{source}: expected a number of pieces, found {text!r}")
    return limit, int(text)


def _first(option: tuple[str | None, str], variable: tuple[str | None, str], default: str) -> tuple[str, str]:
    """Return what somebody has said, and where."""
    given, source = option if option[0] is not None else variable
    return given or default, source
