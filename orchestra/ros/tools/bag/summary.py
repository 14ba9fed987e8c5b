"""What a bag says of itself: `metadata.yaml` as rosbag2 writes and reads it, in version 9, that of Jazzy.

Times are in nanoseconds.
"""

from __future__ import annotations

from typing import Any, Final

import yaml

from orchestra.dataclass import dataclass

FILE: Final = "metadata.yaml"
STORAGE: Final = "mcap"
UNKNOWN: Final = "unknown"
# Looked up here, so that what is put off is imported before there are threads.
_DUMPER: Final = getattr(yaml, "CSafeDumper", yaml.SafeDumper)
_KEY: Final = "rosbag2_bagfile_information"
_VERSION: Final = 9
_NANOSECONDS: Final = 1_000_000_000
_ENDLESS: Final = {"sec": 9_223_372_036, "nsec": 854_775_807}
_SPANS: Final = ("deadline", "lifespan", "liveliness_lease_duration")
_WORDS: Final = ("history", "reliability", "durability", "liveliness")
# The numbers that rosbag2 wrote before version 9 (rmw/types.h).
_NUMBERS: Final = {
    "history": ("system_default", "keep_last", "keep_all", "unknown"),
    "reliability": ("system_default", "reliable", "best_effort", "unknown", "best_available"),
    "durability": ("system_default", "transient_local", "volatile", "unknown", "best_available"),
    "liveliness": (
        *("system_default", "automatic", "manual_by_node", "manual_by_topic", "unknown"),
        "best_available",
    ),
}


@dataclass(frozen=True, slots=True)
class Topic:
    """A topic of a bag; `profiles` is what its publishers offered, as `data_of` gives QoS."""

    name: str
    type: str
    type_hash: str = ""
    profiles: tuple[dict[str, Any], ...] = ()
    count: int = 0


@dataclass(frozen=True, slots=True)
class Part:
    """One file of a bag, with the times of its first and its last message, 0 where there is none."""

    path: str
    start: int = 0
    end: int = 0
    count: int = 0


@dataclass(frozen=True, slots=True)
class Summary:
    """All of it.

    `start` and `end` are the times of the first and the last message, 0 where there is none; `mode` is FILE or MESSAGE
    where these are compressed; `custom` is what its maker says besides.
    """

    parts: tuple[Part, ...]
    topics: tuple[Topic, ...]
    start: int = 0
    end: int = 0
    distribution: str = "jazzy"
    storage: str = STORAGE
    mode: str = ""
    custom: tuple[tuple[str, str], ...] = ()

    @property
    def files(self) -> tuple[str, ...]:
        """The names of its files."""
        return tuple(part.path for part in self.parts)

    @property
    def count(self) -> int:
        """How many messages there are."""
        return sum(topic.count for topic in self.topics)


def document(summary: Summary) -> dict[str, Any]:
    """Return what stands below the one key of `metadata.yaml`."""
    return {
        "version": _VERSION,
        "storage_identifier": summary.storage,
        "duration": {"nanoseconds": summary.end - summary.start},
        "starting_time": {"nanoseconds_since_epoch": summary.start},
        "message_count": summary.count,
        "topics_with_message_count": [
            {
                "topic_metadata": {
                    "name": topic.name,
                    "type": topic.type,
                    "serialization_format": "cdr",
                    "offered_qos_profiles": [_profile(one) for one in topic.profiles],
                    "type_description_hash": topic.type_hash,
                },
                "message_count": topic.count,
            }
            for topic in summary.topics
        ],
        "compression_format": "zstd" if summary.mode else "",
        "compression_mode": summary.mode,
        "relative_file_paths": list(summary.files),
        "files": [
            {
                "path": part.path,
                "starting_time": {"nanoseconds_since_epoch": part.start},
                "duration": {"nanoseconds": part.end - part.start},
                "message_count": part.count,
            }
            for part in summary.parts
        ],
        "custom_data": dict(summary.custom) or None,
        "ros_distro": summary.distribution,
    }


def metadata_text(summary: Summary) -> str:
    """Return the text of `metadata.yaml`."""
    return _dumped({_KEY: document(summary)})


def stored_text(summary: Summary) -> str:
    """Return what the storage file itself has of it."""
    return _dumped(document(summary))


def profiles_text(profiles: tuple[dict[str, Any], ...]) -> str:
    """Return the profiles of a topic as a channel of the storage file has them."""
    return _dumped([_profile(one) for one in profiles]) if profiles else ""


def read_profiles(text: str) -> tuple[dict[str, Any], ...]:
    """Return the profiles of such a text; what cannot be read is left out."""
    try:
        found = yaml.safe_load(text)
    except yaml.YAMLError:
        return ()
    return (
        tuple(_read_profile(one) for one in found if isinstance(one, dict)) if isinstance(found, list) else ()
    )


def storage_files(text: str) -> tuple[list[str], str]:
    """Return the files that a `metadata.yaml` names, and of which ROS it is. Raises `ValueError` where it is none."""
    try:
        found = yaml.safe_load(text)[_KEY]
        files = found["relative_file_paths"]
    except (yaml.YAMLError, TypeError, KeyError) as error:
        raise ValueError(str(error)) from None
    return [str(file) for file in files], str(found.get("ros_distro") or UNKNOWN)


def _dumped(data: object) -> str:
    return yaml.dump(data, Dumper=_DUMPER, sort_keys=False)


def _profile(data: dict[str, Any]) -> dict[str, Any]:
    words = {name: data[name] for name in _WORDS}
    spans = {name: _ENDLESS.copy() if data[name] is None else _split(data[name]) for name in _SPANS}
    return {
        "history": words["history"],
        "depth": data["depth"],
        "reliability": words["reliability"],
        "durability": words["durability"],
        "deadline": spans["deadline"],
        "lifespan": spans["lifespan"],
        "liveliness": words["liveliness"],
        "liveliness_lease_duration": spans["liveliness_lease_duration"],
        "avoid_ros_namespace_conventions": False,
    }


def _split(seconds: float) -> dict[str, int]:
    whole, rest = divmod(round(seconds * _NANOSECONDS), _NANOSECONDS)
    return {"sec": whole, "nsec": rest}


def _read_profile(found: dict[str, Any]) -> dict[str, Any]:
    spans = {name: _seconds(found.get(name)) for name in _SPANS}
    words = {name: _word(name, found.get(name)) for name in _WORDS}
    depth = found.get("depth", 0)
    return {**words, "depth": depth if isinstance(depth, int) else 0, **spans}


def _word(policy: str, value: object) -> str:
    if isinstance(value, int) and 0 <= value < len(_NUMBERS[policy]):
        return _NUMBERS[policy][value]
    return value if isinstance(value, str) and value in _NUMBERS[policy] else "unknown"


def _seconds(value: object) -> float | None:
    """Return a duration in seconds; None for an endless one, or one that is not given."""
    match value:
        case {"sec": int(sec), "nsec": int(nsec)} if sec + nsec > 0 and sec < _ENDLESS["sec"]:
            return sec + nsec / _NANOSECONDS
    return None
