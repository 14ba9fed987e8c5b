"""Files of another kind than what is asked for: a launch file for parameters, parameters for a launch file.

The mistake is where such a file is named, whatever the reader of the other kind finds wrong in it.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.load.entities import PARAMETERS
from orchestra.location import displayed

if TYPE_CHECKING:
    from orchestra.location import Location
    from orchestra.resolve.resolution import Resolution

_BY_NAME: Final = re.compile(r"\.py$|\.launch(\.\w+)?$")
_BY_TEXT: Final = re.compile(r"\A\s*<|^launch[ \t]*:", re.MULTILINE)


def refused_as_parameters(path: str, text: str, location: Location, run: Resolution) -> bool:
    """Report a file that no parameters could be read from where it is a launch file; return whether it is."""
    if _BY_NAME.search(path) is None and _BY_TEXT.search(text) is None:
        return False
    message = f"{displayed(path)} is a launch file, not a parameter file"
    run.problems.error(Code.PARAMETER_SYNTAX, message, location)
    return True


def refuse_included_parameters(path: str, location: Location, run: Resolution) -> None:
    """Tell of a parameter file that is included where it is named, not in it."""
    file = displayed(path)
    told = [
        known
        for known in run.problems
        if known.message == PARAMETERS and known.span is not None and known.span.file == file
    ]
    if told:
        run.problems.amend(lambda known: None if known in told else known)
        message = f"{file} is a parameter file, not a launch file"
        run.problems.error(Code.MISSING_KEY, message, location)
