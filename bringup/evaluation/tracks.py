"""From tracks to a recording and back: streams with stamps of their own become rows of common times."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bringup.evaluation.recording import CONTACTS, FILTERED, NIS, TRUTH, WHEELS, RecordingError
from bringup.evaluation.track import Track

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bringup.evaluation.recording import Recording, Writer
    from bringup.evaluation.track import Rows

NANOSECONDS = 10**9
POSE = 3
UPPER = np.triu_indices(POSE)
# Rows of a track in a second, at most.
RATE = 10
FEWEST = 2


def write(writer: Writer, tracks: Sequence[Track]) -> None:
    """Write whole tracks; the fact `robots` and what else is known of the run are the caller's to tell."""
    writer.tell({"parts": _parts(tracks)})
    for number, track in enumerate(tracks):
        for row, time in enumerate(track.times.tolist()):
            stamp = round(time * NANOSECONDS)
            writer.add(TRUTH, number, stamp, track.truth[row].tolist())
            writer.add(WHEELS, number, stamp, track.wheels[row].tolist())
            filtered = (*track.filtered[row].tolist(), *track.covariance[row][UPPER].tolist())
            writer.add(FILTERED, number, stamp, filtered)
        for place, part in enumerate(_parts(tracks)):
            for time, square, size in track.nis.get(part, np.zeros((0, POSE))).tolist():
                writer.add(NIS, number, round(time * NANOSECONDS), (square, size, place))
        writer.add(CONTACTS, number, round(track.times[-1] * NANOSECONDS), (track.contacts,))
        writer.flush()


def tracks(recording: Recording) -> list[Track]:
    """The tracks of all robots of which truth, wheels and filter are known. Raises RecordingError if there is none."""
    starts = recording.facts.get("starts", {})
    found = [
        track
        for number, robot in enumerate(recording.facts.get("robots", []))
        if (track := _track(recording, number, robot, starts.get(robot, (0.0, 0.0, 0.0)))) is not None
    ]
    if not found:
        raise RecordingError("the recording has no robot of which truth, wheel odometry and filter are known")
    return found


def _parts(tracks: Sequence[Track]) -> list[str]:
    return sorted({part for track in tracks for part in track.nis})


def _track(recording: Recording, number: int, robot: str, start: Sequence[float]) -> Track | None:
    truth_at, truth = recording.of(TRUTH, number)
    wheels_at, wheels = recording.of(WHEELS, number)
    stamps, filtered = recording.of(FILTERED, number)
    known = min(len(truth_at), len(wheels_at))
    if known >= FEWEST:
        first, last = max(truth_at[0], wheels_at[0]), min(truth_at[-1], wheels_at[-1])
        within = (stamps >= first) & (stamps <= last) & _thinned(stamps)
        stamps, filtered = stamps[within], filtered[within]
    if known < FEWEST or len(stamps) < FEWEST:
        return None
    _, contacts = recording.of(CONTACTS, number)
    return Track(
        robot=robot,
        start=(float(start[0]), float(start[1]), float(start[2])),
        times=stamps / NANOSECONDS,
        truth=_between(stamps, truth_at, truth),
        wheels=_between(stamps, wheels_at, wheels),
        filtered=filtered[:, :POSE],
        covariance=_symmetric(filtered[:, POSE:]),
        nis=_nis(recording, number),
        contacts=int(contacts[-1, 0]) if len(contacts) else 0,
    )


def _thinned(stamps: NDArray[np.int64]) -> NDArray[np.bool_]:
    """The first row of each tenth of a second."""
    tenth = stamps * RATE // NANOSECONDS
    first: NDArray[np.bool_] = np.diff(tenth, prepend=tenth[:1] - 1) > 0
    return first


def _between(stamps: NDArray[np.int64], known_at: NDArray[np.int64], poses: Rows) -> Rows:
    """The poses at some stamps, between those that are known; headings turn through the smaller angle."""
    unwrapped = np.column_stack((poses[:, 0], poses[:, 1], np.unwrap(poses[:, 2])))
    since, known = (stamps - known_at[0]).astype(float), (known_at - known_at[0]).astype(float)
    x, y, yaw = (np.interp(since, known, unwrapped[:, axis]) for axis in range(POSE))
    return np.column_stack((x, y, np.pi - np.remainder(np.pi - yaw, 2.0 * np.pi)))


def _symmetric(halves: Rows) -> Rows:
    whole = np.zeros((len(halves), POSE, POSE))
    whole[:, UPPER[0], UPPER[1]] = halves
    whole[:, UPPER[1], UPPER[0]] = halves
    return whole


def _nis(recording: Recording, number: int) -> dict[str, Rows]:
    rows = recording.rows[(recording.rows["kind"] == NIS) & (recording.rows["robot"] == number)]
    return {
        part: np.column_stack((rows["stamp"][mine] / NANOSECONDS, rows["values"][mine, :2]))
        for place, part in enumerate(recording.facts.get("parts", []))
        if (mine := rows["values"][:, 2] == place).any()
    }
