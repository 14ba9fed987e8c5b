"""Files that code of a launch file opens, and programs that it starts, which are not there: the one that was meant."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.explanation import Explanation
from orchestra.compat.seam import connection
from orchestra.errors import Code

if TYPE_CHECKING:
    from orchestra.compat.place import Place


def explained(error: FileNotFoundError, place: Place) -> Explanation | None:
    """Explain a file, a folder or a program that is not there; None where the error does not tell which."""
    name = error.filename
    if not isinstance(name, str) or not name:
        return None
    code = Code.MISSING_FILE
    if "/" not in name and _is_of_a_start(error):
        code = Code.MISSING_EXECUTABLE
        severity, told, meant = connection().missing_program(name)
    else:
        severity, told, meant = connection().missing_file(name, place.file)
    return Explanation(told, code, place.span, meant, severity=severity)


def _is_of_a_start(error: FileNotFoundError) -> bool:
    """Return whether it was raised where a program was to be started."""
    last = error.__traceback__
    while last is not None and last.tb_next is not None:
        last = last.tb_next
    return last is not None and last.tb_frame.f_globals.get("__name__") == "subprocess"
