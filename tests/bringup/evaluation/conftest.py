"""Runs that need no simulation: tracks whose errors are drawn from the covariance that they tell."""

from collections.abc import Callable

import numpy as np
import pytest

from bringup.evaluation.track import Track


@pytest.fixture(scope="session")
def track() -> Callable[..., Track]:
    """A robot on a circle; its filter errs as it says, times `excess`."""

    def make(
        robot: str = "robot1", *, rows: int = 400, excess: float = 1.0, seed: int = 0, contacts: int = 0
    ) -> Track:
        chance = np.random.default_rng(seed)
        times = np.arange(1, rows + 1) / 10
        angle = 0.2 * times
        truth = np.column_stack(
            (np.sin(angle), 1.0 - np.cos(angle), np.remainder(angle + np.pi, 2 * np.pi) - np.pi)
        )
        shape = np.array([[0.04, 0.0, 0.0], [0.01, 0.03, 0.0], [0.005, -0.01, 0.02]])
        errors = excess * chance.standard_normal((rows, 3)) @ shape.T
        return Track(
            robot=robot,
            start=(1.0, -2.0, 0.5),
            times=times,
            truth=truth,
            wheels=truth + 0.02 * times[:, np.newaxis],
            filtered=truth + errors,
            covariance=np.tile(shape @ shape.T, (rows, 1, 1)),
            nis={"odom0_twist": np.column_stack((times, chance.chisquare(2, rows), np.full(rows, 2.0)))},
            contacts=contacts,
        )

    return make
