r"""Backslashes in double quotes that mean nothing there: `"C:\maps"`, `"^\d+$"`."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.description.source import shortened

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.load.faults import Fault
    from orchestra.load.yaml_failure import Failure

_ESCAPE: Final = re.compile(r"\\(.)")
_MEANING: Final = '0abt\tnvfre "/\\N_LPxuU'  # behind a backslash


def of_escape(failure: Failure) -> Fault:
    """Explain a backslash; where there are more in the text, they are one mistake with it."""
    at = failure.text.rfind("\\", 0, failure.at + 1)
    written = failure.text[at : at + 2]
    message = f"{written} means nothing in double quotes: a backslash is written \\\\ there"
    begin, end = failure.text.rfind('"', 0, at), failure.text.find('"', at)
    whole = failure.text[begin + 1 : end]
    if 0 <= begin < end and "\n" not in whole and "'" not in whole:
        message += f", or all is in single quotes: '{shortened(whole)}'"
    return failure.fault(message, at, at + 2, f"\\{written}")


def escaped(text: str, at: int) -> Iterator[tuple[int, int, str]]:
    """Yield what all backslashes from the first that means nothing to the end of its text are to be."""
    end = text.find('"', at)
    for found in _ESCAPE.finditer(text, at, end if end >= 0 else len(text)):
        if found[1] not in _MEANING:
            yield (*found.span(), f"\\{found[0]}")
