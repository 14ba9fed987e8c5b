"""`bag info`: what is in a bag, as rosbag2 tells it."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from service_msgs.msg import ServiceEventInfo

from orchestra.ros.tools.bag.reading import Bag
from orchestra.ros.tools.bag.selection import EVENTS
from orchestra.ros.tools.telling import lines, tell, warn

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.ros.tools.bag.summary import Summary, Topic

_NANOSECONDS: Final = 1_000_000_000
_UNITS: Final = ("B", "KiB", "MiB", "GiB", "TiB")
_STEP: Final = 1024
_WIDTH: Final = 19
_EVENT: Final = "_Event"
# The first field of an event, behind the header of CDR, is what has happened: in two of four cases a request.
_FIRST: Final = 4
_REQUESTS: Final = (ServiceEventInfo.REQUEST_SENT, ServiceEventInfo.REQUEST_RECEIVED)


def info(options: Namespace) -> int:
    """Write it."""
    with Bag(Path(options.bag)) as bag:
        told, size = bag.summary(), bag.size
        broken = [str(file) for file in bag.broken]
        counts = _event_counts(bag) if options.verbose else {}
    for file in broken:
        warn(f"warning: {file} has no end: what is told is what can be read of it")
    if options.topic_name:
        names = [topic.name for topic in told.topics if not _is_service(topic)]
        tell(options, lines(names), names)
        return 0
    tell(options, _text(told, size, counts), _data(told, size, broken))
    return 0


def _text(told: Summary, size: int, counts: dict[str, tuple[int, int]]) -> str:
    services = [topic for topic in told.topics if _is_service(topic)]
    topics = [topic for topic in told.topics if not _is_service(topic)]
    rows = [
        ("Files", "\n".join(told.files)),
        ("Bag size", amount(size)),
        ("Storage id", told.storage),
        ("ROS Distro", told.distribution),
        ("Duration", f"{(told.end - told.start) / _NANOSECONDS:.9f}s"),
        ("Start", _moment(told.start)),
        ("End", _moment(told.end)),
        ("Messages", str(told.count)),
        ("Topic information", "\n".join(map(_topic, topics))),
        ("Service", str(len(services))),
    ]
    text = "".join(_row(f"{name}:", value) for name, value in rows)
    shown = "\n".join(_service(topic, counts.get(topic.name)) for topic in services)
    return text + _row("Service information:", shown, _WIDTH + 2)


def _row(name: str, value: str, width: int = _WIDTH) -> str:
    first, *rest = value.split("\n")
    return "".join([f"{name:<{width}}{first}\n", *(f"{'':<{width}}{line}\n" for line in rest)])


def _event_counts(bag: Bag) -> dict[str, tuple[int, int]]:
    """Return how many requests and responses there are among the events of each service."""
    found: dict[str, tuple[int, int]] = {}
    for one in bag.messages(lambda name: name.endswith(EVENTS)):
        asked, answered = found.get(one.topic, (0, 0))
        is_request = one.data[_FIRST] in _REQUESTS
        found[one.topic] = (asked + is_request, answered + (not is_request))
    return found


def _is_service(topic: Topic) -> bool:
    return topic.name.endswith(EVENTS) and topic.type.endswith(_EVENT)


def _service(topic: Topic, counts: tuple[int, int] | None) -> str:
    name, kind = topic.name.removesuffix(EVENTS), topic.type.removesuffix(_EVENT)
    asked = (
        f"Event Count: {topic.count}"
        if counts is None
        else f"Request Count: {counts[0]} | Response Count: {counts[1]}"
    )
    return f"Service: {name} | Type: {kind} | {asked} | Serialization Format: cdr"


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
        "distribution": told.distribution,
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
