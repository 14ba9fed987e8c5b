"""Each demand is held up alone."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from bringup.evaluation.bar import Summary, moments, outcome, summary, unmet
from bringup.evaluation.table import heading, lines, row
from bringup.evaluation.track import Track

GOOD = Summary(
    filtered=0.1,
    wheels=1.0,
    worst_ratio=0.15,
    moments=(30.0, 60.0),
    inside=(0.8, 1.0),
    mean_nees=(2.0, 3.0),
    contacts=0,
)


def test_what_meets_all_demands_leaves_nothing_to_say() -> None:
    assert list(unmet(GOOD)) == []


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"filtered": 0.201}, "0.201 of wheel odometry's, 0.2 allowed"),
        ({"inside": (0.79, 1.0)}, "at 30 s 79% of the errors"),
        ({"contacts": 2}, "touched something 2 times"),
    ],
)
def test_a_demand_that_is_not_met_is_told(change: dict[str, object], told: str) -> None:
    faults = list(unmet(replace(GOOD, **change)))  # type: ignore[arg-type]
    assert len(faults) == 1
    assert told in faults[0]


def test_moments_are_those_that_a_run_reaches() -> None:
    assert moments(120.0) == (30.0, 60.0, 120.0)
    assert moments(70.0) == (30.0, 60.0)
    assert moments(5.0) == (5.0,)


def test_a_summary_is_of_all_runs(track: Callable[..., Track]) -> None:
    at = moments(40.0)
    outcomes = [
        outcome("arena 1", track("robot1"), at),
        outcome("arena 1", track("robot2", excess=30.0, seed=1, contacts=1), at),
    ]
    figures = summary(outcomes, at)
    assert outcomes[0].inside == (True,)
    assert figures.inside == (0.5,)
    assert figures.contacts == 1
    assert figures.worst_ratio == outcomes[1].ratio > figures.ratio > outcomes[0].ratio
    assert figures.filtered**2 == pytest.approx((outcomes[0].filtered ** 2 + outcomes[1].filtered ** 2) / 2)
    assert len(list(unmet(figures))) == 3
    text = "\n".join([heading(at), *map(row, outcomes), *lines(figures)])
    assert "NEES 30 s" in text
    assert f"{outcomes[1].nees[0]:.2f}*" in text
    assert "at 30 s: 50.0% of the errors" in text
