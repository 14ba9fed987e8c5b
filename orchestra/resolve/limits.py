"""`limits`, evaluated."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, cast

from orchestra.description.limits import SCHEDULERS
from orchestra.description.limits import Rlimits as WrittenRlimits
from orchestra.description.ranges import NICE, PRIORITY
from orchestra.description.text import span_of
from orchestra.errors import Code
from orchestra.resolve.amounts import UnfitError, made, whole
from orchestra.resolve.context import POISON, Poison
from orchestra.resolve.quantities import SIZES, cap, cores, distinct, lock, rlimit
from orchestra.resolve.sound import Sound
from orchestra.values import Limits

if TYPE_CHECKING:
    from orchestra.description.limits import Limits as Written
    from orchestra.resolve.resolution import Resolution
    from orchestra.values import Scheduler

_REAL_TIME = ("fifo", "rr")


def limits(written: Written | None, run: Resolution) -> Limits | Poison | None:
    """Return what a process may use, None where nothing is said."""
    if written is None:
        return None
    sound = Sound()
    found = Limits(
        cores=sound(_cores(written, run)),
        exclusive=sound(run.flag(written.exclusive)) is True,
        nice=sound(whole(written.nice, NICE, run)),
        scheduler=cast("Scheduler | None", sound(run.word(written.scheduler, SCHEDULERS))),
        priority=sound(whole(written.priority, PRIORITY, run)),
        memory=sound(made(written.memory, cap, run)),
        rlimits=sound(_rlimits(written, run)) or {},
    )
    if sound.faulty or written.faulty or not _is_scheduled(found, written, run):
        return POISON
    return found


def _is_scheduled(found: Limits, written: Written, run: Resolution) -> bool:
    """Return whether scheduler and priority go together; where not, it is reported."""
    if (found.scheduler in _REAL_TIME) == (found.priority is not None):
        return True
    if found.priority is None:
        place, message = written.scheduler, f"the scheduler {found.scheduler} needs a `priority` from 1 to 99"
    else:
        place = written.priority
        message = f"`priority` goes with the schedulers fifo and rr, not with {found.scheduler}"
    run.problems.error(Code.CONFLICTING_KEYS, message, run.at((place or written).span))
    return False


def _cores(written: Written, run: Resolution) -> tuple[int, ...] | Poison | None:
    if not isinstance(written.cores, tuple):
        return made(written.cores, lambda text: distinct(cores(text)), run)
    sound = Sound()
    each = [sound(made(item, cores, run)) for item in written.cores]
    if sound.faulty:
        return POISON
    found = tuple(core for item in each for core in item or ())
    try:
        return distinct(found)
    except UnfitError as error:
        run.problems.error(Code.BAD_VALUE, error.reason, run.at(span_of(written.cores) or written.span))
        return POISON


def _rlimits(written: Written, run: Resolution) -> dict[str, tuple[int, ...]] | Poison:
    found: dict[str, tuple[int, ...]] = {}
    sound = Sound()
    locked = sound(made(written.memory_lock, lock, run))
    if locked is not None:
        found["memlock"] = (locked, locked)
    for name, entry in WrittenRlimits.model_fields.items():
        text = getattr(written.rlimits, name, None)
        word = entry.alias or name
        pair = sound(made(text, partial(rlimit, is_size=word in SIZES), run))
        if pair is not None:
            found[word] = pair
    return POISON if sound.faulty else dict(sorted(found.items()))
