"""Variables that nobody reads and whose names are slips for such as are read."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.nearest import one_slip
from orchestra.resolve.mentions import names_in

if TYPE_CHECKING:
    from orchestra.resolve.ledger import Ledger
    from orchestra.resolve.resolution import Resolution


def warn_of_idle_lets(ledger: Ledger, run: Resolution) -> None:
    """Tell of variables that are set for nobody where one letter makes another name of it.

    Any other one may be set for a file that code includes, or one that is not here.
    """
    useful = ledger.read | run.found.lost
    idle = {name: at for name, at in run.found.lets.items() if name not in useful}
    if not idle or ledger.incomplete:
        return
    known = sorted((ledger.declared | run.found.lets.keys()) - idle.keys())
    hidden = names_in(part.action for part in ledger.hidden)
    for name, at in idle.items():
        meant = None if name in hidden else one_slip(name, known)
        if meant is not None:
            run.problems.warning(Code.UNREAD_ARGUMENT, f"nothing reads '{name}'", at, suggestion=meant)
