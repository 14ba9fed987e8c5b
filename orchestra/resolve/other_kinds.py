"""Files of another kind than what is asked for: a launch file for parameters, parameters for a launch file.

The mistake is where such a file is named, whatever the reader of the other kind finds wrong in it.
"""

from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.load.entities import PARAMETERS
from orchestra.location import displayed
from orchestra.patterns import pattern
from orchestra.resolve.launch_files import TEXTS

if TYPE_CHECKING:
    from orchestra.compat.place import Place
    from orchestra.description.actions.include import Include
    from orchestra.location import Location
    from orchestra.resolve.resolution import Resolution

_BY_NAME: Final = pattern(r"\.py$|\.launch(\.\w+)?$")
_ENDINGS: Final = {"python": (".py",), "xml": (".xml",), "yaml": (".yaml", ".yml")}
_OWN: Final = {
    ".xml": "XMLLaunchDescriptionSource",
    ".yaml": "YAMLLaunchDescriptionSource",
    ".yml": "YAMLLaunchDescriptionSource",
}
_BY_TEXT: Final = pattern(r"\A\s*<|^launch[ \t]*:", re.MULTILINE)


def refused_as_parameters(path: str, text: str, location: Location, run: Resolution) -> bool:
    """Report a file that no parameters could be read from where it is a launch file; return whether it is."""
    if _BY_NAME.search(path) is None and _BY_TEXT.search(text) is None:
        return False
    message = f"{displayed(path)} is a launch file, not a parameter file"
    run.problems.error(Code.PARAMETER_SYNTAX, message, location)
    return True


def refused_as_language(path: str, action: Include, location: Location, run: Resolution) -> bool:
    """Report a file that is included as one of a language which its ending contradicts; return whether it is."""
    endings, ending = _ENDINGS.get(action.language or "", ()), os.path.splitext(path)[1]  # noqa: PTH122 - pathlib is slow
    if not endings or ending in endings or ending not in TEXTS:
        return False
    # Here, because only mistakes need them, and what they import.
    from orchestra.compat.literals import call_at  # noqa: PLC0415
    from orchestra.compat.rewritten import Rewritten  # noqa: PLC0415
    from orchestra.compat.syntax_trees import node_span  # noqa: PLC0415

    place: Place | None = getattr(getattr(action.origin, "launch_description_source", None), "_place", None)
    call = None if place is None else call_at(place)
    span = location.span if call is None or place is None else node_span(place.file, call.func)
    meant = "PythonLaunchDescriptionSource" if ending in _ENDINGS["python"] else "AnyLaunchDescriptionSource"
    language = {"python": "Python"}.get(action.language or "", str(action.language).upper())
    others = "" if ending in _ENDINGS["python"] else f" or {_OWN[ending]}"
    message = f"{displayed(path)} is no launch file in {language}: {meant}{others} reads it"
    run.problems.error(
        Code.UNKNOWN_FORMAT,
        message,
        replace(location, span=span),
        suggestion=None if call is None else Rewritten(meant),
    )
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
