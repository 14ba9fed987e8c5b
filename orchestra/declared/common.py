"""Parameters that nodes have without declaring them themselves: those of rclcpp and rclpy."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from orchestra.declared.model import RosType

# By name, with their types. rclcpp: node_time_source, type_description_service, qos_overrides; rclpy: Node. Jazzy.
COMMON: Final[dict[str, RosType]] = {"use_sim_time": "bool", "start_type_description_service": "bool"}
_GROUPS: Final = ("qos_overrides",)


def is_common(name: str) -> bool:
    """Return whether every node may have a parameter of this name."""
    return name in COMMON or name.partition(".")[0] in _GROUPS
