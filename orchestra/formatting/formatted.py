"""A file in its one form, or the reason why it is left as it is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.formatting.formats import format_of
from orchestra.formatting.refusal import NotFormatted
from orchestra.formatting.text_file import read_text
from orchestra.load.encodings import UndecodableError
from orchestra.location import Location, point

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.errors import Problems
    from orchestra.formatting.formats import Format

WIDTH = 120


def formatted(
    content: bytes, file: str, kind_of: Callable[[str], str], problems: Problems, width: int = WIDTH
) -> bytes | None:
    """Return the bytes of a file as they should be, None where it cannot be read (which has been reported).

    `kind_of` tells by its text what a file is, `launch` or `parameters`. What comes out says the same as what came in,
    and formatting it again changes nothing: otherwise, and where something in it has no form here, raises
    `NotFormatted`.
    """
    try:
        source = read_text(content)
    except UndecodableError as error:
        problems.error(Code.SYNTAX, str(error), Location(point(file, error.line, error.column)))
        return None
    how = format_of(file, kind_of(source.text), source.text)
    before = len(problems.errors)
    how.faults(source.text, file, problems)
    if len(problems.errors) > before:
        return None
    return source.encoded(_checked(source.text, how, width))


def _checked(text: str, how: Format, width: int) -> str:
    """Return the text laid out. Raises `NotFormatted` where anything else about it would change."""
    laid_out = how.laid_out(text, width)
    if laid_out == text:
        return text
    if how.sense(laid_out) != how.sense(text):
        raise NotFormatted("it would not say the same any more (a fault of the formatter's)")
    if how.laid_out(laid_out, width) != laid_out:
        raise NotFormatted("it would change again when formatted again (a fault of the formatter's)")
    return laid_out
