"""Who reads what is typed: there is one terminal."""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.errors import Problems
    from orchestra.resolve.model import ResolvedProcess

_STDIN: Final = attrgetter("stdin")


def check_stdin(processes: Mapping[str, ResolvedProcess], problems: Problems) -> None:
    """Report every process but the first that has `stdin`; the processes by their ids."""
    if not any(map(_STDIN, processes.values())):
        return
    reading = [
        (identity, process.stdin) for identity, process in processes.items() if process.stdin is not None
    ]
    for identity, place in reading[1:]:
        first, at = reading[0]
        message = f"'{identity}' and '{first}' cannot both read what is typed"
        problems.error(Code.CONFLICTING_KEYS, message, place, notes=(f"`stdin` of '{first}' is at {at}",))
