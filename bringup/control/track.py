"""Where the robot was lately, so that a scan is put where it was taken and not where the robot has come since."""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass, replace

from bringup.control.command import Pose, wrapped

# Seconds for which poses are kept.
KEPT = 2.0


@dataclass(frozen=True, slots=True)
class Track:
    """Times in s and the poses then, in order of time."""

    times: tuple[float, ...] = ()
    poses: tuple[Pose, ...] = ()


def extended(track: Track, time: float, pose: Pose) -> Track:
    """The track with a newer pose. One that is older than the last means a clock that was set back: only it counts."""
    if track.times and time <= track.times[-1]:
        return track if time == track.times[-1] else Track((time,), (pose,))
    first = bisect_left(track.times, time - KEPT)
    return replace(track, times=(*track.times[first:], time), poses=(*track.poses[first:], pose))


def at(track: Track, time: float) -> Pose | None:
    """The pose at that time, between the two about it or the nearest one; None for an empty track."""
    if not track.times:
        return None
    after = bisect_left(track.times, time)
    if after in (0, len(track.times)):
        return track.poses[min(after, len(track.times) - 1)]
    one, other = track.poses[after - 1], track.poses[after]
    share = (time - track.times[after - 1]) / (track.times[after] - track.times[after - 1])
    return Pose(
        one.x + share * (other.x - one.x),
        one.y + share * (other.y - one.y),
        wrapped(one.yaw + share * wrapped(other.yaw - one.yaw)),
    )
