"""What counts for the outcome of a run, as it comes about."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.supervise.outcome import Facts
from orchestra.supervise.process.ending import Ending
from orchestra.supervise.process.life import Phase

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.supervise.process.unit import Unit


class Verdict:
    """Collects it; of each kind the first counts, and everything that went wrong."""

    def __init__(self, units: Mapping[str, Unit], *, fail_on_any: bool) -> None:
        self._units = units
        self._fail_on_any = fail_on_any
        self._signal: int | None = None
        self._required: tuple[str, Ending] | None = None
        self._failure: str | None = None
        self._ended_by: str | None = None
        self._mishaps: list[str] = []

    def signalled(self, number: int) -> None:
        """Somebody wants the run to end, by a signal."""
        self._signal = number if self._signal is None else self._signal

    def failed(self, reason: str) -> None:
        """The run ends because of something that is nobody's exit code."""
        self._failure = reason

    def ended_by(self, reason: str) -> None:
        """The run ends as it should."""
        self._ended_by = reason if self._ended_by is None else self._ended_by

    def went_wrong(self, what: str) -> None:
        """Something that the plan says was not done; the run goes on."""
        self._mishaps.append(what)

    def required_end(self) -> Unit | None:
        """Return a required process that is over, unless an operator has ended it; one that failed before others."""
        over = [
            unit
            for unit in self._units.values()
            if unit.process.required and unit.over and not unit.state.halted
        ]
        return next(filter(_has_failed, over), over[0] if over else None)

    def blame(self) -> Unit | None:
        """Keep the required process that has failed, whether its end or a trigger on its end stops the run."""
        unit = self.required_end()
        if unit is None or not _has_failed(unit):
            return None
        self._required = (unit.name, unit.state.ending or Ending(code=1))
        return unit

    def facts(self, left: Mapping[int, str]) -> Facts:
        """Return it all; `left` names by pid what is there although nothing should be."""
        failed = tuple(
            (unit.name, unit.state.ending or Ending(code=1))
            for unit in self._units.values()
            if unit.state.phase is Phase.FAILED
        )
        return Facts(
            unstoppable=tuple(left.values()),
            required=self._required,
            signal=self._signal,
            failure=self._failure,
            failed=failed,
            mishaps=tuple(self._mishaps),
            fail_on_any=self._fail_on_any,
            ended_by=self._ended_by,
        )


def _has_failed(unit: Unit) -> bool:
    return unit.state.phase is Phase.FAILED
