"""The figures of many runs as plain text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bringup.evaluation.bar import LARGEST_RATIO, LEAST_INSIDE

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bringup.evaluation.bar import Outcome, Summary


def heading(at: Sequence[float]) -> str:
    """What stands over the rows."""
    columns = "".join(f"{f'NEES {moment:g} s':>12}" for moment in at)
    return f"{'run':<16}{'robot':<10}{'filtered m':>11}{'wheels m':>10}{'ratio':>8}{columns}{'contacts':>10}"


def row(outcome: Outcome) -> str:
    """One robot's run; a star marks an error outside of the 95 % ellipse."""
    columns = "".join(
        f"{f'{value:.2f}' + (' ' if within else '*'):>12}"
        for value, within in zip(outcome.nees, outcome.inside, strict=True)
    )
    return (
        f"{outcome.run:<16}{outcome.robot:<10}{outcome.filtered:>11.3f}{outcome.wheels:>10.3f}"
        f"{outcome.ratio:>8.3f}{columns}{outcome.contacts:>10}"
    )


def lines(figures: Summary) -> Iterator[str]:
    """All runs together."""
    yield (
        f"position error (RMS): filtered {figures.filtered:.3f} m, wheel odometry {figures.wheels:.3f} m: "
        f"{figures.ratio:.3f} of it ({LARGEST_RATIO:g} allowed), {figures.worst_ratio:.3f} in the worst run"
    )
    for moment, share, mean in zip(figures.moments, figures.inside, figures.mean_nees, strict=True):
        yield (
            f"at {moment:g} s: {share:.1%} of the errors in (x, y, yaw) inside the 95 % ellipse "
            f"({LEAST_INSIDE:.0%} wanted); mean NEES {mean:.2f} (3 if the covariance is exact)"
        )
    yield f"contacts: {figures.contacts}"
