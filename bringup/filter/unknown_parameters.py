"""Parameters that nobody reads: each is told with the known name that is nearest to it."""

import difflib
import re
from collections.abc import Iterable

from bringup.filter.parameter_reader import Reader

_SENSOR = re.compile(r"(odom|pose|twist|imu)(\d+)(_\w+)?")
_ENDINGS = {
    "odom": (
        *("config", "queue_size", "differential", "relative", "pose_use_child_frame", "widens_start"),
        *("pose_rejection_threshold", "twist_rejection_threshold"),
    ),
    "pose": ("config", "queue_size", "differential", "relative", "rejection_threshold"),
    "twist": ("config", "queue_size", "rejection_threshold"),
    "imu": (
        *("config", "queue_size", "differential", "relative", "remove_gravitational_acceleration"),
        *("pose_rejection_threshold", "twist_rejection_threshold"),
        "linear_acceleration_rejection_threshold",
    ),
}
# As near as a slip of the keys.
_SIMILAR = 0.6


def tell_unread(reader: Reader) -> None:
    """Tell what is set and has no effect: why, or what may have been meant."""
    for name in reader.unread():
        reader.report.warning(f"parameter {name} is unknown and has no effect; {_hint(name, reader)}")


def _hint(name: str, reader: Reader) -> str:
    sensor = _SENSOR.fullmatch(name)
    if sensor is not None:
        kind, number, ending = sensor.group(1), int(sensor.group(2)), sensor.group(3)
        missing = next((n for n in range(number) if not reader.has(f"{kind}{n}")), None)
        if missing is not None:
            return f"{kind}{missing} is missing, and sensors are counted from 0 without a gap"
        if ending is not None and ending[1:] in _ENDINGS[kind] and not reader.has(f"{kind}{number}"):
            return f"{kind}{number}, its topic, is missing"
    near = _nearest(name, (*reader.in_force, *_names_of_sensor(sensor)))
    return f"did you mean {near}?" if _likeness(name, near) >= _SIMILAR else f"the nearest name is {near}"


def _names_of_sensor(sensor: re.Match[str] | None) -> Iterable[str]:
    """What could be said of a sensor of this name."""
    if sensor is None:
        return ()
    return (f"{sensor.group(1)}{sensor.group(2)}_{ending}" for ending in _ENDINGS[sensor.group(1)])


def _nearest(name: str, known: Iterable[str]) -> str:
    return max(sorted(set(known)), key=lambda candidate: _likeness(name, candidate))


def _likeness(name: str, candidate: str) -> float:
    """How alike two names are, from 0 to 1, be it with their words in another order."""
    name, candidate = name.lower(), candidate.lower()
    return max(
        difflib.SequenceMatcher(None, name, candidate).ratio(),
        difflib.SequenceMatcher(None, _sorted(name), _sorted(candidate)).ratio(),
    )


def _sorted(name: str) -> str:
    return "_".join(sorted(name.split("_")))
