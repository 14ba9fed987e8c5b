"""Many runs in lockstep, shared among processes."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context
from typing import TYPE_CHECKING

from bringup.evaluation.bar import Outcome, moments, outcome
from bringup.evaluation.lockstep import run
from bringup.evaluation.scenario import Choice, scenario

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence


@dataclass(frozen=True, slots=True)
class Runs:
    """Which runs: every seed in every world."""

    worlds: tuple[str, ...]
    seeds: tuple[int, ...]
    choice: Choice


def outcomes(runs: Runs, jobs: int) -> Iterator[Outcome]:
    """What each robot's run comes to, in the order of worlds and seeds; `jobs` of the runs at a time."""
    pairs = [(world, seed) for world in runs.worlds for seed in runs.seeds]
    one = partial(_outcomes, runs.choice)
    if jobs == 1:
        for pair in pairs:
            yield from one(pair)
        return
    # Fresh interpreters: MuJoCo and numpy have threads, which a fork would leave behind.
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        for each in pool.map(one, pairs):
            yield from each


def _outcomes(choice: Choice, pair: tuple[str, int]) -> Sequence[Outcome]:
    world, seed = pair
    at = moments(choice.seconds)
    return [outcome(f"{world} {seed}", track, at) for track in run(scenario(choice, world=world, seed=seed))]
