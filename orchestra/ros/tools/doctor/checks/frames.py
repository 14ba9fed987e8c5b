"""Whether transforms form trees, are renewed, and are not too old."""

from __future__ import annotations

from bisect import bisect_right
from itertools import pairwise
from statistics import median
from typing import TYPE_CHECKING, Final

from orchestra.ros.tools.doctor.observed import Finding

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.ros.tools.doctor.observed import Heard, Observed, Tick

OLD: Final = 0.1
# A transform that is not renewed for so much longer than usual, and for so long, has a gap.
_GAP, _TIMES = 0.5, 5


def check(seen: Observed) -> Iterator[Finding]:
    """Yield what is wrong with the trees; then, of frames with one parent, what is wrong with their times."""
    parents: dict[str, set[str]] = {}
    for heard in seen.transforms:
        parents.setdefault(heard.child, set()).add(heard.parent)
    several = {child: found for child, found in parents.items() if len(found) > 1}
    for child, found in sorted(several.items()):
        message = f"the frame {child} has {len(found)} parents: {', '.join(sorted(found))}"
        yield Finding("frames", message, (child,), {"frame": child, "parents": sorted(found)})
    single = {child: next(iter(found)) for child, found in parents.items() if len(found) == 1}
    if circle := _circle(single):
        message = f"the frames {' -> '.join([*circle, circle[0]])} are in a circle"
        yield Finding("frames", message, tuple(circle), {"circle": circle})
    else:
        yield from _unconnected(parents)
    for child in sorted(single):
        yield from _times(seen, [heard for heard in seen.transforms if heard.child == child])


def _circle(parents: dict[str, str]) -> list[str]:
    """Return the frames of a circle, from the first by name; none where there is none."""
    for start in sorted(parents):
        way = [start]
        while (above := parents.get(way[-1])) is not None and above not in way:
            way.append(above)
        if above == start:
            return way
    return []


def _unconnected(parents: dict[str, set[str]]) -> Iterator[Finding]:
    """Yield trees that nothing connects though frames of both have one prefix.

    Robots have trees of their own: their frames differ in prefixes, or but for numbers not at all.
    """
    groups: dict[str, dict[tuple[str, ...], set[str]]] = {}
    for frames in _connected(parents):
        roots = tuple(sorted(frames - {*parents}))
        for prefix in {frame.rpartition("/")[0] for frame in frames}:
            groups.setdefault(prefix, {})[roots] = frames
    told = set()
    for _, members in sorted(groups.items()):
        roots = tuple(", ".join(found) for found in sorted(members))
        if len({_without_digits(frames) for frames in members.values()}) > 1 and roots not in told:
            told.add(roots)
            message = f"nothing connects the frames below {' with those below '.join(roots)}"
            yield Finding("frames", message, roots, {"roots": list(roots)})


def _connected(parents: dict[str, set[str]]) -> list[set[str]]:
    """Return the sets of frames that transforms connect, whichever way."""
    sets: list[set[str]] = []
    for child, above in parents.items():
        joined = {child, *above}
        apart = []
        for found in sets:
            if found & joined:
                joined |= found
            else:
                apart.append(found)
        sets = [*apart, joined]
    return sets


def _without_digits(frames: set[str]) -> frozenset[str]:
    return frozenset("".join(letter for letter in frame if not letter.isdigit()) for frame in frames)


def _times(seen: Observed, heard: Sequence[Heard]) -> Iterator[Finding]:
    """Yield that a transform is too old, or that it has a gap; the first says more."""
    moving = sorted((one for one in heard if not one.static), key=lambda one: one.sent)
    if not moving:
        return
    name = f"{moving[0].parent} -> {moving[0].child}"
    about = (moving[0].parent, moving[0].child)
    late = median(_age(one, seen.ticks) for one in moving)
    intervals = [after.sent - before.sent for before, after in pairwise([*moving])]
    usual = median(intervals) if intervals else max(seen.until - moving[0].sent, 0.0)
    # Between two messages it grows older: so old it is in the mean.
    age = late + usual / 2
    if age > OLD:
        why = f"it comes {late:.2g} s late" if late > usual / 2 else f"it is renewed every {usual:.2g} s"
        message = f"the transform {name} is {age:.2g} s old: {why}"
        yield Finding(
            "frames", message, about, {"parent": about[0], "frame": about[1], "age": age, "late": late}
        )
        return
    longest = max([*intervals, seen.until - moving[-1].sent])
    if longest > max(_GAP, _TIMES * usual):
        message = (
            f"the transform {name} was not renewed for {longest:.2g} s, which it is every {usual:.2g} s else"
        )
        yield Finding("frames", message, about, {"parent": about[0], "frame": about[1], "gap": longest})


def _age(heard: Heard, ticks: Sequence[Tick]) -> float:
    """Return how old a transform was when it was sent, by the clock that its stamp is nearer to."""
    ages = [heard.sent - heard.stamp]
    if ticks:
        place = max(bisect_right(ticks, heard.sent, key=lambda tick: tick.sent) - 1, 0)
        ages.append(ticks[place].time - heard.stamp)
    return min(ages, key=abs)
