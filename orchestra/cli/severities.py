"""The option `--severity CODE=LEVEL` of the commands that read launch files."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code, UsageError
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

_LEVELS = ("off", "warning", "error")


def add_to(parser: ArgumentParser) -> None:
    """Let a parser read it."""
    parser.add_argument(
        "--severity",
        action="append",
        default=[],
        metavar="CODE=off|warning|error",
        help="how much the problems of a code weigh; it wins over settings files; may be given more than once",
    )


def given(options: Namespace) -> dict[str, str]:
    """Return what the options say for codes. Raises `UsageError`."""
    return dict(_read(word) for word in getattr(options, "severity", ()))


def _read(word: str) -> tuple[str, str]:
    code, _, level = word.partition("=")
    _expect(code, [known.value for known in Code], "code", word)
    _expect(level, _LEVELS, "severity", word)
    return code, level


def _expect(found: str, known: list[str] | tuple[str, ...], what: str, word: str) -> None:
    if found not in known:
        near = nearest(found.upper() if what == "code" else found, known)
        hint = f"; did you mean '{near}'?" if near else ""
        raise UsageError(f"--severity {word}: there is no {what} '{found}'{hint}")
