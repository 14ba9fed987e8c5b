"""Whether /clock has one source, and it and the clock of the machine go on evenly."""

from __future__ import annotations

from itertools import pairwise
from statistics import median
from typing import TYPE_CHECKING, Final

from orchestra.ros.tools.doctor.checks.time import CLOCK
from orchestra.ros.tools.doctor.observed import Finding

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.ros.tools.doctor.observed import Observed, Tick

# What a clock goes further than its own rate lets expect, in seconds, and in usual steps, before it counts as a jump.
_JUMP, _STEPS = 0.5, 10
_SET: Final = 0.05


def check(seen: Observed) -> Iterator[Finding]:
    """Yield several publishers of /clock; where there is one, its jumps."""
    givers = sorted(end.node for end in seen.system.publishers if end.topic == CLOCK)
    if len(givers) > 1:
        message = f"{CLOCK} has {len(givers)} publishers: {', '.join(givers)}"
        yield Finding("clock", message, tuple(givers), {"publishers": givers})
    elif found := list(jumps(seen.ticks)):
        before, after = found[0]
        way = "back" if after.time < before.time else "ahead"
        size = f"{abs(after.time - before.time):.3g} s, from {before.time:.9g} s"
        often = f", and {len(found) - 1} times more" if len(found) > 1 else ""
        facts = [{"from": before.time, "to": after.time} for before, after in found]
        yield Finding("clock", f"{CLOCK} jumps {way} by {size}{often}", (CLOCK,), {"jumps": facts})
    if abs(seen.set_by) > _SET:
        message = f"the clock of this machine was set by {seen.set_by:+.3g} s in the last seconds"
        yield Finding("clock", message, (), {"set_by": seen.set_by})


def jumps(ticks: Sequence[Tick]) -> Iterator[tuple[Tick, Tick]]:
    """Yield the ticks before and after each jump. A clock may be slower or faster than real time."""
    steps = [(after.sent - before.sent, after.time - before.time) for before, after in pairwise(ticks)]
    going = [(sent, time) for sent, time in steps if sent > 0 and time > 0]
    if not going:
        rate, usual = 1.0, 0.0
    else:
        rate = median(time / sent for sent, time in going)
        usual = median(time for _, time in going)
    for (before, after), (sent, time) in zip(pairwise(ticks), steps, strict=True):
        ahead = time - rate * max(sent, 0.0)
        if time < 0 or ahead > max(_JUMP, _STEPS * usual):
            yield before, after
