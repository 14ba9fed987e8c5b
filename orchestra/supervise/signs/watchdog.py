"""Sign of life: the process says WATCHDOG=1 often enough (sd_notify(3))."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.supervise.signs.deadline import Deadline
from orchestra.supervise.signs.notification import seconds

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.loop import Loop
    from orchestra.supervise.signs.notification import Notices

_OWNER = "watchdog"


class Watchdog:
    """Expects WATCHDOG=1 at least every `period` seconds, and an end within `farewell` seconds after STOPPING=1.

    `silent` is told that nothing came; False says that this is no hang. The process may change the period by
    WATCHDOG_USEC=, and ask to be taken for hung by WATCHDOG=trigger.
    """

    def __init__(
        self, loop: Loop, notices: Notices, period: float, farewell: float, silent: Callable[[str], bool]
    ) -> None:
        self._asked = self._period = period
        self._notices = notices
        self._farewell = farewell
        self._silent = silent
        self._active = False
        self._signs = Deadline(loop, self._none_came)
        self._end = Deadline(loop, self._not_ended)
        for variable, heard in (
            ("WATCHDOG", self._sign),
            ("WATCHDOG_USEC", self._change),
            ("STOPPING", self._leave),
        ):
            notices.on(variable, heard, owner=_OWNER)

    def begin(self, *, armed: bool) -> None:
        """Expect it from now on; where it is not armed, from the first sign on."""
        self._active = True
        self._period = seconds(self._notices.latest("WATCHDOG_USEC")) or self._asked
        if armed:
            self._signs.begin(self._period)

    def end(self) -> None:
        """Expect nothing any more."""
        self._active = False
        self._signs.end()
        self._end.end()

    def _sign(self, value: str) -> None:
        if not self._active or self._end.runs:
            return
        if value == "trigger":
            self._silent("it said WATCHDOG=trigger")
        elif value == "1" and self._signs.runs:
            self._signs.sign()
        elif value == "1":
            self._signs.begin(self._period)

    def _change(self, value: str) -> None:
        period = seconds(value)
        if self._active and period:
            self._period = period
            if self._signs.runs:
                self._signs.begin(period)

    def _leave(self, value: str) -> None:
        if self._active and value == "1" and not self._end.runs:
            self._signs.end()
            self._end.begin(self._farewell)

    def _none_came(self) -> None:
        if not self._silent(f"no WATCHDOG=1 for {self._period:g} s"):
            self._signs.begin(self._period)

    def _not_ended(self) -> None:
        if not self._silent(f"it has not ended within {self._farewell:g} s after STOPPING=1"):
            self._end.begin(self._farewell)
