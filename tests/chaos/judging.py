"""What is wrong with a run that has been played: an empty list is what the documentation promises."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from tests.chaos import outputs
from tests.chaos.playing import HANG
from tests.chaos.statuses import allowed, fate, judged_roots

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tests.chaos.cases import Case, Root
    from tests.chaos.playing import Observation

# Of ourselves: what processes say has their name before it.
_BUGS = (r"(?m)^Traceback \(most recent", "this is a bug in Orchestra")


def judge(case: Case, seen: Observation) -> list[str]:
    """Return every promise that was broken."""
    return [*_left(case, seen), *_ended(case, seen), *_told(case, seen), *_logged(case, seen)]


def _left(case: Case, seen: Observation) -> Iterator[str]:
    remains = seen.remains
    # Whether shared memory came during the run is told by the time of its file, on the clock that leaps.
    litter = tuple(path for path in remains.litter if not (case.leaps and "fastrtps_" in path))
    left = {
        "process": remains.processes,
        "socket": remains.sockets,
        "file": litter,
        "control group": remains.groups,
    }
    for kind, names in left.items():
        if names:
            yield f"left behind, {kind}: {len(names)}, {', '.join(names[:4])}"


def _ended(case: Case, seen: Observation) -> Iterator[str]:
    if seen.lasted >= HANG:
        yield f"it hangs: nothing has ended {HANG:g} s after the last act"
    elif seen.status not in allowed(case, seen):
        yield f"its status is {seen.status}, and not one of {sorted(allowed(case, seen))}"
    # What has the terminal for itself speaks without its name.
    bugs = _BUGS[1:] if any(root.stdin for root in case.roots) else _BUGS
    yield from (f"it says {words!r}" for words in bugs if re.search(words, seen.screen))


def _told(case: Case, seen: Observation) -> Iterator[str]:
    """Check the stream of events, where there was a disk to write it to and a supervisor that lived."""
    if seen.fault:
        yield f"the events cannot be read: {seen.fault}"
    if case.disk or not seen.events:
        return
    befell = fate(seen)
    if befell.supervisor_killed or befell.supervisor_frozen:
        return
    last = seen.events[-1]
    if last.kind != "run_ended":
        yield f"the last event is {last.kind}"
    elif not befell.keeper_killed and last.data["status"] != seen.status:
        yield f"the last event says {last.data['status']}, and the status is {seen.status}"
    if sum(event.kind == "run_ended" for event in seen.events) > 1:
        yield "the run ended more than once"
    for root in case.roots:
        kinds = [event.kind for event in seen.events if event.process == root.member.name]
        if kinds.count("process_running") != kinds.count("process_ended"):
            yield f"{root.member.name} began {kinds.count('process_running')} times and ended {kinds.count('process_ended')} times"


def _logged(case: Case, seen: Observation) -> Iterator[str]:
    """Check what the processes wrote, where it could be written."""
    if case.disk or any(each.act.deed == "remove logs" for each in seen.deliveries):
        return
    befell = fate(seen)
    dead = befell.supervisor_killed or befell.supervisor_frozen
    for root in judged_roots(case):
        yield from (f"{root.member.name}: {fault}" for fault in _log_faults(root, seen, dead=dead))


def _log_faults(root: Root, seen: Observation, *, dead: bool) -> Iterator[str]:
    whole, faults = outputs.check(seen.logs[root.member.name])
    yield from faults[:3]
    if dead:
        return
    ends = [
        event for event in seen.events if event.kind == "process_ended" and event.process == root.member.name
    ]
    expected = sum(event.data.get("code") == root.member.code for event in ends)
    for letter in "o" if root.tty or root.stdin else "oe":
        if whole[letter] != expected:
            yield f"it wrote {expected} times all it had to say to stream {letter}, and {whole[letter]} are in its log"
