"""With which QoS a topic of a bag is published again."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, HistoryPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy

if TYPE_CHECKING:
    from collections.abc import Sequence

# Nothing is lost where several messages come at once. What is not known of the recorded publishers (0) is this much.
_DEEP: Final = 1000


def offer(profiles: Sequence[dict[str, Any]]) -> QoSProfile:
    """Return the profile that offers as much as any of the recorded publishers did; the default where none is known.

    What all of them promised is promised: deadline, lifespan and liveliness where they agree.
    """
    made = QoSProfile(history=HistoryPolicy.KEEP_LAST, depth=_DEEP)
    if not profiles:
        return made
    if not any(one["reliability"] == "reliable" for one in profiles):
        made.reliability = ReliabilityPolicy.BEST_EFFORT
    if any(one["durability"] == "transient_local" for one in profiles):
        made.durability = DurabilityPolicy.TRANSIENT_LOCAL
        made.depth = max(one["depth"] for one in profiles) or _DEEP
    if all(one["liveliness"] == "manual_by_topic" for one in profiles):
        made.liveliness = LivelinessPolicy.MANUAL_BY_TOPIC
    for name in ("deadline", "lifespan", "liveliness_lease_duration"):
        spans = {one[name] for one in profiles}
        if len(spans) == 1 and (span := spans.pop()) is not None:
            setattr(made, name, Duration(seconds=span))
    return made
