"""Plain scalars of parameter files that rcl reads as something else than they say.

Told is what readers of YAML disagree about (rcl's parser, YAML 1.1 as PyYAML reads it, YAML 1.2) and what nobody can
mean. A number in another notation, as `1e-6` or `0x10`, arrives as the number that it is.
"""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.description.source import shortened
from orchestra.errors import Code
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.errors import Problems
    from orchestra.location import Location, Span
    from orchestra.resolve.rcl.sections import Entry, Section
    from orchestra.values import ParameterValue, Scalar

_LETTERS: Final = frozenset("yYnN")
_NULLS: Final = frozenset({"~", "null", "Null", "NULL"})
_NO_NUMBER: Final = pattern(r"(?P<sign>[-+]?)\.?(?P<word>inf(?:inity)?|nan)(?:\(\w*\))?", re.IGNORECASE)
_AS_YAML: Final = pattern(r"[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)")
_NOT_FINITE: Final = {"nan": ".nan", "inf": ".inf", "-inf": "-.inf"}
_ZEROS: Final = pattern(r"(?P<sign>[-+]?)0+(?P<digits>[1-9][0-9]*)")
_GROUPED: Final = pattern(r"[-+]?[0-9]+(?:_[0-9]+)+(?:\.[0-9_]*)?")
_HALF_QUOTED: Final = pattern(r"""[^\s"']+["']""")
_WHOLE: Final = pattern(r"[-+]?[0-9]+")
_PREFIXED: Final = pattern(r"[-+]?0(?:o(?P<octal>[0-7]+)|b(?P<binary>[01]+))")


_NOT_PLAIN: Final = ("'", '"', "!", "&", "|", ">", "")
_NUMERIC: Final = frozenset("0123456789.+-tTfF(")
_ENDS: Final = frozenset("0123456789)iI")  # of what may be computed
_TYPESET: Final = frozenset("\u201c\u201d\u201e\u2018\u2019\u201a\u00ab\u00bb")
_OPENING: Final = {"]": "[", "}": "{"}
BREAK: Final = pattern("\r\n|[\r\n\x85\u2028\u2029]")


@dataclass(frozen=True, slots=True)
class Surprise:
    """What is to be said of a scalar, and what should stand in its place, where that is known."""

    message: str
    instead: str | None


def report_surprises(sections: Sequence[Section], text: str, problems: Problems) -> None:
    """Report what is surprising about the values in the text of a file; in a list the first."""
    from orchestra.resolve.rcl.oddities import report_oddities  # noqa: PLC0415 - only files have them

    lines = BREAK.split(text)
    report_oddities(sections, lines, problems)
    for section in sections:
        for entry in section.entries:
            for value, location in _scalars(entry):
                written = _written(location.span, lines)
                found = (
                    surprise(written, value) if written is not None else _over_lines(value, location, lines)
                )
                if found is not None:
                    problems.warning(
                        Code.SURPRISING_SCALAR, found.message, location, suggestion=found.instead
                    )
                    break


def _scalars(entry: Entry) -> Iterator[tuple[Scalar, Location]]:
    if isinstance(entry.value, tuple):
        yield from zip(entry.value, entry.items, strict=False)
    elif entry.value is not None:
        yield entry.value, entry.location


def _written(span: Span, lines: Sequence[str]) -> str | None:
    """Return the text of a plain scalar, None for one in quotes, with a tag or on several lines."""
    if span.line != span.end_line:
        return None
    text = lines[span.line - 1][span.column - 1 : span.end_column - 1]
    return None if text[:1] in _NOT_PLAIN else text


def _over_lines(value: Scalar, location: Location, lines: Sequence[str]) -> Surprise | None:
    """Return what is surprising about a plain text on several lines, of which no other can be put in place."""
    span = location.span
    if not isinstance(value, str) or span.line == span.end_line:
        return None
    plain = lines[span.line - 1][span.column - 1 :][:1] not in _NOT_PLAIN
    found = half_open(value) if plain else None
    return None if found is None else Surprise(found.message, None)


def plainly(text: str, value: ParameterValue, quote: str | None) -> str | None:
    """Return how a text of a launch file is written so that it cannot be read otherwise, None where that is not clear.

    A text in a `quote` stays a text, if there is one.
    """
    if isinstance(value, tuple):
        return None
    if ":" in text or (isinstance(value, bool) and text in _LETTERS):
        return f"{quote}{text}{quote}" if quote is not None else None
    if isinstance(value, bool):
        return str(value).lower()
    zeros = _ZEROS.fullmatch(text)
    if zeros is not None:
        return f"{zeros['sign']}{zeros['digits']}"
    if isinstance(value, float) and not math.isfinite(value):
        return _NOT_FINITE[str(value)]
    return str(value) if not isinstance(value, str) else None


def surprise(text: str, value: Scalar) -> Surprise | None:
    """Return what is surprising about the value that rcl reads in a plain scalar, None where nothing is."""
    if isinstance(value, bool):
        return _of_boolean(text, value)
    if isinstance(value, str):
        return _of_text(text)
    return _of_number(text, value)


def _of_boolean(text: str, value: bool) -> Surprise | None:
    word = str(value).lower()
    if text.lower() == word:
        return None
    instead = f'"{text}"' if text in _LETTERS else word
    meaning = "in quotes it is a text" if text in _LETTERS else f'write {word}, or "{text}" for a text'
    return Surprise(f"'{text}' is read as the boolean {word}: {meaning}", instead)


def _of_text(text: str) -> Surprise | None:
    if (half := half_open(text)) is not None:
        return half
    if text[:1] in _TYPESET and text[-1:] in _TYPESET:
        told = f"the quotes of '{shortened(text)}' are part of the text: YAML knows only ' and \""
        return Surprise(told, f'"{text[1:-1]}"' if '"' not in text and "\\" not in text else None)
    if not text.isascii() and (alike := _of_look_alike(text)) is not None:
        return alike
    if text in _NULLS:
        return Surprise(f"'{text}' is read as a text: no parameter is without a value", f'"{text}"')
    if _GROUPED.fullmatch(text):
        return Surprise(f"'{text}' is read as a text: numbers have no '_' here", text.replace("_", ""))
    if prefixed := _PREFIXED.fullmatch(text):
        number = int(prefixed["octal"], 8) if prefixed["octal"] else int(prefixed["binary"], 2)
        sign = "-" if text.startswith("-") else ""
        return Surprise(f"'{text}' is read as a text, not as the number {sign}{number}", f"{sign}{number}")
    return of_commas(text) or _of_computed(text)


def _of_computed(text: str) -> Surprise | None:
    """Return what is to be said of a text that a number was to be computed from."""
    if text[-1:] not in _ENDS or text.isdigit():
        return None
    from orchestra.resolve.rcl.computed import computed, may_be_ratio  # noqa: PLC0415 - few texts end so

    number = computed(text)
    if number is None or may_be_ratio(text):
        return None
    return Surprise(f"'{text}' is read as a text: nothing is computed in a parameter file", number)


def _of_look_alike(text: str) -> Surprise | None:
    from orchestra.resolve.rcl.look_alikes import look_alike  # noqa: PLC0415 - few texts are not of ASCII

    plain = look_alike(text)
    if plain is None:
        return None
    return Surprise(f"'{text}' is read as a text: not all of its characters are what they look like", plain)


def of_commas(text: str) -> Surprise | None:
    """Return what is to be said of a plain text that is a number, several or a boolean, but for a slip."""
    if text[:1] not in _NUMERIC:
        return None
    from orchestra.resolve.rcl.commas import without_slip  # noqa: PLC0415 - few texts begin so

    found = without_slip(text)
    if found is None:
        return None
    why, instead = found
    return Surprise(f"'{shortened(text)}' is read as a text: {why}", instead)


def half_open(text: str) -> Surprise | None:
    """Return what is to be said of a plain text that ends with a quote or a bracket that nothing opens."""
    last = text[-1:]
    if _HALF_QUOTED.fullmatch(text):
        return Surprise(
            f"the {last} at the end of '{text}' is part of the text: nothing opens it", last + text
        )
    opening = _OPENING.get(last)
    if opening is None or "," not in text or opening in text or text.count(last) > 1:
        return None
    told = f"the {last} at the end of '{shortened(text)}' is part of the text: no {opening} opens it"
    return Surprise(told, opening + text)


def _of_number(text: str, value: float) -> Surprise | None:
    zeros = _ZEROS.fullmatch(text)
    if zeros is not None and str(value) != f"{zeros['sign'].strip('+')}{zeros['digits']}":
        how = "in base 8" if isinstance(value, int) else "as no whole number"
        message = f"'{text}' is read as {value}: a number that begins with 0 is read {how}, as a text it is \"{text}\""
        return Surprise(message, f"{zeros['sign']}{zeros['digits']}")
    if isinstance(value, float) and _WHOLE.fullmatch(text) and zeros is None:
        return Surprise(f"'{text}' is read as the float {value}: it does not fit into 64 bits", f'"{text}"')
    word = _NO_NUMBER.fullmatch(text)
    if word is not None and not _AS_YAML.fullmatch(text):
        instead = f"{word['sign'] if word['word'].lower() != 'nan' else ''}.{word['word'].lower()[:3]}"
        return Surprise(
            f"'{text}' is read as the float {value}: write {instead}, or \"{text}\" for a text", instead
        )
    return None
