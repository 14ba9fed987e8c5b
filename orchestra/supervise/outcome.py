"""The exit status of a run, and the sentence that says why.

Precedence: 4 something could not be stopped, 3 a bug, 2 the description, the code of the first failed required process,
128+n a signal to the run, 1 the run failed otherwise, 0. The resolver gives 2 before there
is a run, and the boundary 3.
"""

from __future__ import annotations

from orchestra.dataclass import dataclass
from orchestra.supervise.process.ending import Ending, signal_name

OK, FAILED, MISTAKE, BUG, UNSTOPPABLE = 0, 1, 2, 3, 4
_SIGNALLED = 128


@dataclass(frozen=True, slots=True)
class Facts:
    """What counts for the outcome of a run.

    `required` is the first required process that failed, `signal` the first stop signal, `failure` why the run failed
    otherwise, `ended_by` why it ended where nothing failed. `failed` are all processes that failed, `mishaps` says what
    else did not happen as described: components, transitions. `unstoppable` names what was left.
    """

    unstoppable: tuple[str, ...] = ()
    required: tuple[str, Ending] | None = None
    signal: int | None = None
    failure: str | None = None
    failed: tuple[tuple[str, Ending], ...] = ()
    mishaps: tuple[str, ...] = ()
    fail_on_any: bool = False
    ended_by: str | None = None


@dataclass(frozen=True, slots=True)
class Outcome:
    """How a run ended."""

    status: int
    reason: str


def judge(facts: Facts) -> Outcome:
    """Return the outcome of a run."""
    status, reason = _verdict(facts)
    others = [f"{name} ({ending})" for name, ending in facts.failed if (name, ending) != facts.required]
    named = ["failed: " + ", ".join(others)] if others else []
    return Outcome(status, "; ".join([reason, *named, *facts.mishaps]))


def _verdict(facts: Facts) -> tuple[int, str]:
    if facts.unstoppable:
        return UNSTOPPABLE, "could not be stopped: " + ", ".join(facts.unstoppable)
    if facts.required:
        name, ending = facts.required
        # One that hung, or should not have ended with 0, has failed even so.
        return ending.status or FAILED, f"required process {name} failed ({ending})"
    if facts.signal is not None:
        return _SIGNALLED + facts.signal, f"stopped by {signal_name(facts.signal)}"
    if facts.failure:
        return FAILED, facts.failure
    ended_by = facts.ended_by or "every process has ended"
    count = len(facts.failed) + len(facts.mishaps)
    if count and facts.fail_on_any:
        what = "something went wrong" if facts.mishaps else "one failed" if count == 1 else "some failed"
        return FAILED, f"{ended_by}, and {what}"
    return OK, ended_by
