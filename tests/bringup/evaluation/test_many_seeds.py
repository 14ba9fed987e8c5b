"""The bar, with both worlds and seeds that nothing was tuned to."""

import os

import pytest

from bringup.evaluation.bar import moments, summary, unmet
from bringup.evaluation.many import Runs, outcomes
from bringup.evaluation.scenario import Choice
from bringup.world.layout import WORLDS

SEEDS = tuple(range(1, 21))


@pytest.mark.long
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("world", WORLDS)
def test_twenty_seeds_of_two_minutes_meet_all_demands(world: str) -> None:
    found = list(outcomes(Runs((world,), SEEDS, Choice(120.0)), os.cpu_count() or 1))
    figures = summary(found, moments(120.0))
    assert list(unmet(figures)) == []
    assert figures.worst_ratio < 0.5
    assert len(found) == 2 * len(SEEDS)


@pytest.mark.long
@pytest.mark.timeout(900)
def test_runs_shared_among_processes_are_those_of_one() -> None:
    runs = Runs(("arena",), (1, 2), Choice(5.0))
    assert list(outcomes(runs, 2)) == list(outcomes(runs, 1))
