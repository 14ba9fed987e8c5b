"""QoS of single topics from a file, as rosbag2 takes it: a mapping from topics to policies."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import yaml
from rclpy.duration import Duration
from rclpy.qos import QoSProfile

from orchestra.errors import UsageError
from orchestra.nearest import nearest
from orchestra.ros.tools.graph.names import absolute
from orchestra.ros.tools.graph.qos import POLICIES

if TYPE_CHECKING:
    from collections.abc import Mapping

_SPANS: Final = ("deadline", "lifespan", "liveliness_lease_duration")
_OTHERS: Final = ("depth", "avoid_ros_namespace_conventions")


def overrides(file: str | None) -> dict[str, QoSProfile]:
    """Return the profiles of topics in a file. Raises `UsageError`."""
    if file is None:
        return {}
    try:
        found = yaml.safe_load(Path(file).read_text("utf-8"))
    except yaml.YAMLError as error:
        raise UsageError(f"{file} is no YAML: {error}") from None
    if not isinstance(found, dict) or not all(isinstance(one, dict) for one in found.values()):
        raise UsageError(
            f"{file} is no mapping from topics to policies, as '/scan: {{reliability: best_effort}}'"
        )
    made = {}
    for topic, policies in found.items():
        try:
            made[absolute(str(topic))] = _profile(policies)
        except (ValueError, TypeError, KeyError) as error:
            raise UsageError(f"{file}: {topic}: {error}") from None
    return made


def _profile(policies: Mapping[str, Any]) -> QoSProfile:
    """Return what the policies say; what they do not say is the default of topics."""
    made = QoSProfile(depth=10)
    for name, value in policies.items():
        if name in POLICIES:
            setattr(made, name, _word(name, value))
        elif name in _SPANS:
            setattr(made, name, Duration(seconds=int(value["sec"]), nanoseconds=int(value["nsec"])))
        elif name == "depth":
            made.depth = int(value)
        elif name not in _OTHERS:
            near = nearest(str(name), (*POLICIES, *_SPANS, *_OTHERS))
            raise ValueError(f"there is no policy {name}" + (f"; did you mean {near}?" if near else ""))
    return made


def _word(policy: str, value: Any) -> Any:  # noqa: ANN401 - of an untyped package
    known = POLICIES[policy].short_keys()
    if value not in known:
        raise ValueError(f"{policy} cannot be {value!r}: it is one of {', '.join(known)}")
    return POLICIES[policy].get_from_short_key(value)
