"""Random processes and random assaults: whatever happens, nothing is left, nothing hangs, and the status is the documented one.

`python -m tests.chaos` plays the same from the command line, where a seed can be given and a failure made smaller.
"""

from __future__ import annotations

import os
import time

import pytest

from tests.chaos import cases, inventing
from tests.chaos.campaign import Verdict, burning, verdicts
from tests.chaos.stage import here

_FEW, _MANY = 6, 200
_AT_ONCE = 4


def broken_promises(seed: str, runs: int) -> str:
    """Play the runs of a seed and tell what went wrong, with what repeats it."""
    chosen = [inventing.case(f"{seed}:{number}", here()) for number in range(runs)]
    return "\n".join(_words(verdict) for verdict in verdicts(chosen, _AT_ONCE) if verdict.broken)


def _words(verdict: Verdict) -> str:
    broken = "\n  ".join(verdict.broken)
    return f"{verdict.case.seed}: {broken}\n  python -m tests.chaos --replay '{cases.dumps(verdict.case)}'"


def test_a_few_runs_hold() -> None:
    assert not broken_promises("a few", _FEW)


@pytest.mark.long
@pytest.mark.timeout(3600)
@pytest.mark.parametrize("busy", [0, 2])
def test_many_runs_hold(busy: int) -> None:
    seed = os.environ.get("CHAOS_SEED") or f"{time.time_ns():x}"
    with burning(busy):
        broken = broken_promises(seed, _MANY)
    assert not broken, f"CHAOS_SEED={seed}\n{broken}"


@pytest.mark.parametrize("number", range(20))
def test_a_case_goes_through_json_and_back(number: int) -> None:
    case = inventing.case(f"json:{number}")
    assert cases.loads(cases.dumps(case)) == case
