"""Quotes of arguments: those that are lacking around words and brackets, and those that do not quote."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.description.substitutions import SIGNATURES
from orchestra.errors import Code
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from orchestra.description.source import Written
    from orchestra.errors import Problems

BRACKETS: Final = "a parenthesis in an argument needs quotes or a backslash"
_XML: Final = (".xml", ".launch")
_KEPT_QUOTES: Final = pattern(r"""(['"])([^'" ()$\\]*)\1(?=[ )])""")
_HALF_QUOTED: Final = pattern(r"""[^\s"']*[^\s"'0-9]["']""")
_OF_ROS1: Final = pattern(r"""\barg\(\s*(['"])(\w+)\1\s*\)""")


def in_quotes(raw: str, file: str) -> str | None:
    """Return a text of a file in quotes that it does not hold itself, None where it holds both."""
    quote = next((quote for quote in ("'", '"') if quote not in raw), None)
    if quote == '"' and file.endswith(_XML):  # where it would end the attribute
        raw, quote = raw.replace("&", "&amp;").replace("<", "&lt;"), "&quot;"
    return None if quote is None else f"{quote}{raw}{quote}"


def kept_quotes(text: str, start: int) -> tuple[int, str | None]:
    """Return where quotes end that do not quote, and how they are written with backslashes, which say so themselves."""
    match = _KEPT_QUOTES.match(text, start)
    return (start + 1, None) if match is None else (match.end(), rf"\{match[1]}{match[2]}\{match[1]}")


def phrase_meant(name: str, written: str, file: str, problems: Problems, known: int) -> str | None:
    """Return in quotes the arguments of a substitution that takes an expression or a command, told of by brackets.

    What is told, behind so many problems, is forgotten then. `arg('name')`, as ROS 1 has it, is the variable.
    """
    if name not in SIGNATURES or not SIGNATURES[name].phrase:
        return None
    if {problem.message for problem in [*problems][known:]} != {BRACKETS}:
        return None
    instead = in_quotes(_OF_ROS1.sub(r"\1$(var \2)\1", written), file)
    if instead is not None:
        problems.forget(Code.SUBSTITUTION_SYNTAX, known)
    return instead


def ends_half_quoted(written: Written) -> bool:
    """Tell whether a quote at the end of a text looks like one too many; one that is written as an entity is meant."""
    text = written.text
    if not _HALF_QUOTED.fullmatch(text):
        return False
    quote = written.spans(len(text) - 1, len(text))
    return quote.end_column - quote.column == 1
