"""Parameters that nodes have without declaring them themselves: those of rclcpp and rclpy."""

from __future__ import annotations

from typing import Final

from orchestra.declared.model import Parameter

# rclcpp: node_time_source, type_description_service, qos_overrides; rclpy: Node.__init__. Jazzy.
COMMON: Final = {
    parameter.name: parameter
    for parameter in (
        Parameter("use_sim_time", ("bool",)),
        Parameter("start_type_description_service", ("bool",)),
    )
}
GROUPS: Final = ("qos_overrides",)


def is_common(name: str) -> bool:
    """Return whether every node may have a parameter of this name."""
    return name in COMMON or name.partition(".")[0] in GROUPS
