"""Files that code of a launch file opens and that are not there: the one that was meant."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.explanation import Explanation
from orchestra.compat.seam import connection
from orchestra.errors import Code
from orchestra.location import displayed

if TYPE_CHECKING:
    from orchestra.compat.place import Place


def explained(error: FileNotFoundError, place: Place) -> Explanation | None:
    """Explain a file or folder that is not there; None where the error does not tell which."""
    if not isinstance(error.filename, str) or not error.filename:
        return None
    message = f"there is no file {displayed(error.filename)}, which the code asks for"
    meant = connection().near_file(error.filename)
    return Explanation(message, Code.MISSING_FILE, place.span, suggestion=meant)
