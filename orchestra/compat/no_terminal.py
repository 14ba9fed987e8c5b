"""What code of a launch file asks of the terminal from which it is launched, where there is none."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.compat.explanation import Explanation
from orchestra.compat.seam import connection
from orchestra.compat.source_text import text_at
from orchestra.errors import HERE, Severity

if TYPE_CHECKING:
    from orchestra.compat.place import Place

# What each of them says of it.
_ASKING: Final = {"input(": EOFError, "getlogin(": OSError, "get_terminal_size(": OSError}


def explained(error: EOFError | OSError, place: Place) -> Explanation | None:
    """Explain what only fails without a terminal, where another launch has one; None for anything else."""
    code = text_at(place.file, place.span) or ""
    asking = next((call for call, kind in _ASKING.items() if call in code and isinstance(error, kind)), None)
    severity = connection().missing_terminal()
    if asking is None or severity is Severity.ERROR:
        return None
    return Explanation(f"{asking}) asks for a terminal: there is none {HERE}", severity=severity)
