"""The option `--severity CODE=LEVEL` of the commands that read launch files."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code, UsageError
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace


def add_to(parser: ArgumentParser) -> None:
    """Let a parser read it."""
    parser.add_argument(
        "--severity",
        action="append",
        default=[],
        metavar="CODE=off|note|warning|error",
        help="how much the problems of a code weigh; it wins over settings files; may be given more than once",
    )


def given(options: Namespace) -> dict[str, str]:
    """Return what the options say for codes. Raises `UsageError`."""
    return dict(_read(word) for word in getattr(options, "severity", ()))


def _read(word: str) -> tuple[str, str]:
    # Here, because hardly any command line says something of that.
    from orchestra.settings.model import LEVELS, code_meant  # noqa: PLC0415

    code, _, level = word.partition("=")
    if code not in [known.value for known in Code]:
        raise _unknown(word, f"code '{code}'", code_meant(code))
    if level not in LEVELS:
        raise _unknown(word, f"severity '{level}'", nearest(level, LEVELS))
    return code, level


def _unknown(word: str, what: str, meant: str | None) -> UsageError:
    hint = f"; did you mean '{meant}'?" if meant else ""
    return UsageError(f"--severity {word}: there is no {what}{hint}")
