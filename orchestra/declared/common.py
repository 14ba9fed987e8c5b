"""Parameters that nodes have without declaring them themselves: those of rclcpp and rclpy."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Final

from orchestra.nearest import is_slip

if TYPE_CHECKING:
    from orchestra.declared.model import RosType

# By name, with their types. rclcpp: node_time_source, type_description_service, qos_overrides; rclpy: Node. Jazzy.
COMMON: Final[dict[str, RosType]] = {"use_sim_time": "bool", "start_type_description_service": "bool"}
# Packages with nodes whose parameters are known from their code.
KNOWN: Final = frozenset(
    {
        "joy",
        "nav2_amcl",
        "nav2_lifecycle_manager",
        "nav2_map_server",
        "robot_localization",
        "robot_state_publisher",
        "teleop_twist_joy",
    }
)
_GROUPS: Final = ("qos_overrides",)
_SIM_TIME: Final = "use_sim_time"


def is_common(name: str) -> bool:
    """Return whether every node may have a parameter of this name."""
    return name in COMMON or name.partition(".")[0] in _GROUPS


@lru_cache(maxsize=4096)  # the nodes of a fleet have the same parameters
def common_meant(name: str) -> str | None:
    """Return the parameter of every node that a name is a slip for: `use_simtime` of `use_sim_time`."""
    return _SIM_TIME if name[:1] in ("u", "U") and name != _SIM_TIME and is_slip(name, _SIM_TIME) else None
