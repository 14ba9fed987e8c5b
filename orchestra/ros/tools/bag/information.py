"""`bag info`: what is in a bag, as rosbag2 tells it."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from orchestra.ros.tools.bag.reading import Bag
from orchestra.ros.tools.telling import tell, warn

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.ros.tools.bag.summary import Summary, Topic

_NANOSECONDS: Final = 1_000_000_000
_UNITS: Final = ("B", "KiB", "MiB", "GiB", "TiB")
_STEP: Final = 1024
_WIDTH: Final = 19


def info(options: Namespace) -> int:
    """Write it."""
    with Bag(Path(options.bag)) as bag:
        told, size = bag.summary(), bag.size
        broken = [str(file) for file in bag.broken]
    for file in broken:
        warn(f"warning: {file} has no end: what is told is what can be read of it")
    tell(options, _text(told, size), _data(told, size, broken))
    return 0


def _text(told: Summary, size: int) -> str:
    rows = [
        ("Files", "\n".join(told.files)),
        ("Bag size", amount(size)),
        ("Storage id", told.storage),
        ("Duration", f"{(told.end - told.start) / _NANOSECONDS:.9f}s"),
        ("Start", _moment(told.start)),
        ("End", _moment(told.end)),
        ("Messages", str(told.count)),
        ("Topic information", "\n".join(map(_topic, told.topics))),
    ]
    return "".join(_row(f"{name}:", value) for name, value in rows)


def _row(name: str, value: str) -> str:
    first, *rest = value.split("\n")
    return "".join([f"{name:<{_WIDTH}}{first}\n", *(f"{'':<{_WIDTH}}{line}\n" for line in rest)])


def _topic(topic: Topic) -> str:
    return f"Topic: {topic.name} | Type: {topic.type} | Count: {topic.count} | Serialization Format: cdr"


def _moment(nanoseconds: int) -> str:
    seconds, rest = divmod(nanoseconds, _NANOSECONDS)
    there = time.localtime(seconds)
    return f"{time.strftime('%b %e %Y %H:%M:%S', there)}.{rest:09d} ({seconds}.{rest:09d})"


def amount(size: float) -> str:
    """Return a number of bytes as people write it."""
    unit = 0
    while size >= _STEP and unit < len(_UNITS) - 1:
        size /= _STEP
        unit += 1
    return f"{size:.0f} B" if unit == 0 else f"{size:.1f} {_UNITS[unit]}"


def _data(told: Summary, size: int, broken: list[str]) -> dict[str, Any]:
    return {
        "files": list(told.files),
        "size": size,
        "storage": told.storage,
        "start": told.start,
        "end": told.end,
        "messages": told.count,
        "broken": broken,
        "topics": [
            {
                "name": topic.name,
                "type": topic.type,
                "type_hash": topic.type_hash,
                "messages": topic.count,
                "qos": list(topic.profiles),
            }
            for topic in told.topics
        ],
    }
