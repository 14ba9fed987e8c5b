"""The bar for the bringup's filter: many runs, their figures, and which of the demands they do not meet."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bringup.evaluation.errors import against_truth, inside, nees, position_rms, row_at

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bringup.evaluation.track import Track

# Filtered over wheel odometry's position error, at most.
LARGEST_RATIO = 1 / 5
# When errors are held against the filter's 95 % ellipse (s), and how many of them may lie inside.
MOMENTS = (30.0, 60.0, 120.0)
LEAST_INSIDE = 0.8


@dataclass(frozen=True, slots=True)
class Outcome:
    """What one robot's run came to: RMS position errors in metres; the normalised error squared at each moment."""

    run: str
    robot: str
    filtered: float
    wheels: float
    nees: tuple[float, ...]
    inside: tuple[bool, ...]
    contacts: int

    @property
    def ratio(self) -> float:
        """Filtered over wheel odometry's error."""
        return self.filtered / self.wheels


@dataclass(frozen=True, slots=True)
class Summary:
    """All runs together; `inside` are shares, one for each moment that the runs reach."""

    filtered: float
    wheels: float
    worst_ratio: float
    moments: tuple[float, ...]
    inside: tuple[float, ...]
    mean_nees: tuple[float, ...]
    contacts: int

    @property
    def ratio(self) -> float:
        """Filtered over wheel odometry's error, over all runs."""
        return self.filtered / self.wheels


def moments(seconds: float) -> tuple[float, ...]:
    """The moments that a run of this length reaches; its end, if it reaches none."""
    return tuple(moment for moment in MOMENTS if moment <= seconds) or (seconds,)


def outcome(run: str, track: Track, at: Sequence[float]) -> Outcome:
    """What a track comes to, with its errors looked at closely at some moments."""
    rows = [row_at(track, moment) for moment in at]
    squares, within = nees(track), inside(track)
    return Outcome(
        run=run,
        robot=track.robot,
        filtered=position_rms(against_truth(track.filtered, track.truth)),
        wheels=position_rms(against_truth(track.wheels, track.truth)),
        nees=tuple(float(squares[row]) for row in rows),
        inside=tuple(bool(within[row]) for row in rows),
        contacts=track.contacts,
    )


def summary(outcomes: Sequence[Outcome], at: Sequence[float]) -> Summary:
    """All runs together; every run counts alike."""
    return Summary(
        filtered=_rms([each.filtered for each in outcomes]),
        wheels=_rms([each.wheels for each in outcomes]),
        worst_ratio=max(each.ratio for each in outcomes),
        moments=tuple(at),
        inside=tuple(float(share) for share in np.mean([each.inside for each in outcomes], axis=0)),
        mean_nees=tuple(float(value) for value in np.mean([each.nees for each in outcomes], axis=0)),
        contacts=sum(each.contacts for each in outcomes),
    )


def unmet(figures: Summary) -> Iterator[str]:
    """Each demand that is not met, in words."""
    if figures.ratio > LARGEST_RATIO:
        yield f"filtered position error is {figures.ratio:.3f} of wheel odometry's, {LARGEST_RATIO:g} allowed"
    for moment, share in zip(figures.moments, figures.inside, strict=True):
        if share < LEAST_INSIDE:
            yield f"at {moment:g} s {share:.0%} of the errors lie inside the 95 % ellipse, {LEAST_INSIDE:.0%} wanted"
    if figures.contacts:
        yield f"robots touched something {figures.contacts} times"


def _rms(values: Sequence[float]) -> float:
    return float(np.sqrt(np.mean(np.square(values))))
