"""QoS profiles: from options, from what publishers offer, and as plain data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from rclpy.duration import Duration
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSPresetProfiles,
    QoSProfile,
    ReliabilityPolicy,
    qos_profile_sensor_data,
)

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Sequence

POLICIES: Final = {
    "history": HistoryPolicy,
    "reliability": ReliabilityPolicy,
    "durability": DurabilityPolicy,
    "liveliness": LivelinessPolicy,
}
_LEASE: Final = "qos_liveliness_lease_duration_seconds"
_DURATIONS: Final = ("lifespan", "deadline", "liveliness_lease_duration")
_ENDLESS: Final = 2**62  # what an endpoint of the graph has as an endless duration, in nanoseconds
_NANOSECONDS: Final = 1e9
_MIXED: Final = (
    "Some, but not all, publishers are offering QoS{policy}Policy.{}. Falling back to QoS{policy}Policy.{} "
    "as it will connect to all publishers"
)
_DEEP: Final = 1000  # nothing is lost while the process that hears does something else for a moment


def chosen(options: Namespace, default: QoSProfile = qos_profile_sensor_data) -> tuple[QoSProfile, bool]:
    """Return the profile that the options say, and whether they say a policy of it.

    A profile by its name says none: as in the ROS 2 tools, what publishers offer counts for more.
    """
    named = options.qos_profile
    given = {policy: getattr(options, f"qos_{policy}") for policy in POLICIES}
    depth, lease = options.qos_depth, getattr(options, _LEASE)
    profile = copied(QoSPresetProfiles.get_from_short_key(named) if named else default)
    for policy, word in given.items():
        if word is not None:
            setattr(profile, policy, POLICIES[policy].get_from_short_key(word))
    if depth is not None:
        profile.depth = depth
    elif profile.durability == DurabilityPolicy.TRANSIENT_LOCAL and profile.depth == 0:
        profile.depth = 1
    if lease is not None:
        profile.liveliness_lease_duration = Duration(seconds=lease)
    return profile, depth is not None or lease is not None or any(given.values())


def matched(endpoints: Sequence[Any], profile: QoSProfile) -> tuple[QoSProfile, list[str]]:
    """Return a profile with which a subscription hears all of these publishers, and what is to be said about it."""
    made, notes = copied(profile), []
    made.depth = _DEEP
    if not endpoints:
        return made, []
    reliable = sum(one.qos_profile.reliability == ReliabilityPolicy.RELIABLE for one in endpoints)
    keeping = sum(one.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL for one in endpoints)
    made.reliability = (
        ReliabilityPolicy.RELIABLE if reliable == len(endpoints) else ReliabilityPolicy.BEST_EFFORT
    )
    if 0 < reliable < len(endpoints):
        notes.append(_MIXED.format("RELIABLE", "BEST_EFFORT", policy="Reliability"))
    made.durability = (
        DurabilityPolicy.TRANSIENT_LOCAL if keeping == len(endpoints) else DurabilityPolicy.VOLATILE
    )
    if 0 < keeping < len(endpoints):
        notes.append(_MIXED.format("TRANSIENT_LOCAL", "VOLATILE", policy="Durability"))
    return made, notes


def copied(profile: QoSProfile) -> QoSProfile:
    """Return a profile that may be changed: the presets are shared."""
    made = QoSProfile(history=profile.history, depth=profile.depth)
    for name in (
        "reliability",
        "durability",
        "lifespan",
        "deadline",
        "liveliness",
        "liveliness_lease_duration",
    ):
        setattr(made, name, getattr(profile, name))
    return made


def data_of(profile: Any) -> dict[str, Any]:  # noqa: ANN401 - of an untyped package
    """Return a profile as plain data: durations in seconds, None for endless ones."""
    words = {policy: kind(getattr(profile, policy)).name.lower() for policy, kind in POLICIES.items()}
    spans = {name: _seconds(getattr(profile, name)) for name in _DURATIONS}
    return {**words, "depth": profile.depth, **spans}


def _seconds(duration: Any) -> float | None:  # noqa: ANN401 - as above
    return None if duration.nanoseconds >= _ENDLESS else duration.nanoseconds / _NANOSECONDS
