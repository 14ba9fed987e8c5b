"""Parameters that nobody reads: each is told with the known name that is nearest to it."""

import difflib
import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import takewhile

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
# How alike a name is to one that begins with it; slips of the keys are nearer.
_BEGINNING = 0.8


def tell_unread(reader: Reader, others: Sequence[str]) -> None:
    """Tell what is set and has no effect: why, or what may have been meant.

    `others` are names that would count if something else were set.
    """
    for name in reader.unread():
        hint = _hint(name, reader, others)
        reader.report.warning(f"parameter {name} is unknown and has no effect; {hint}")


def _hint(name: str, reader: Reader, others: Sequence[str]) -> str:
    sensor = _SENSOR.fullmatch(name)
    if sensor is not None:
        kind, number, ending = sensor.group(1), int(sensor.group(2)), sensor.group(3)
        missing = next((n for n in range(number) if not reader.has(f"{kind}{n}")), None)
        if missing is not None:
            return f"{kind}{missing} is missing, and sensors are counted from 0 without a gap"
        if ending is not None and ending[1:] in _ENDINGS[kind] and not reader.has(f"{kind}{number}"):
            return f"{kind}{number}, its topic, is missing"
        kinds: Iterable[str] = (kind,)
    else:
        kinds = _ENDINGS
    general = (known for known in reader.in_force if _SENSOR.fullmatch(known) is None)
    near = _nearest(name, (*general, *others, *_names_of_sensors(name, kinds)))
    return f"did you mean {near}?" if _likeness(name, near) >= _SIMILAR else f"the nearest name is {near}"


def _names_of_sensors(name: str, kinds: Iterable[str]) -> Iterator[str]:
    """What could be said of sensors of these kinds with the numbers that are in a name, or of the first ones."""
    for number in sorted(set(re.findall(r"\d+", name))) or ["0"]:
        for kind in kinds:
            yield f"{kind}{number}"
            yield from (f"{kind}{number}_{ending}" for ending in _ENDINGS[kind])


def _nearest(name: str, known: Iterable[str]) -> str:
    return max(sorted(set(known)), key=lambda candidate: _likeness(name, candidate))


def _likeness(name: str, candidate: str) -> float:
    """How alike two names are, from 0 to 1, be it with their words in another order, or the one cut short."""
    name, candidate = name.lower(), candidate.lower()
    return max(
        _beginning(name, candidate) / len(name) * _BEGINNING,
        difflib.SequenceMatcher(None, name, candidate).ratio(),
        difflib.SequenceMatcher(None, _sorted(name), _sorted(candidate)).ratio(),
    )


def _beginning(name: str, candidate: str) -> int:
    """With how many characters both begin."""
    pairs = zip(name, candidate, strict=False)
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], pairs))


def _sorted(name: str) -> str:
    return "_".join(sorted(name.split("_")))
