"""Whether all that a command may see can be asked for on the wire.

It can with what Orchestra and its users have without saying more: Fast DDS, discovery on this machine alone, and the
usual ports. Who configures the middleware otherwise is served by the middleware.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.ros.tools.graph.ports import tells_ports

if TYPE_CHECKING:
    from collections.abc import Mapping

_MIDDLEWARE: Final = ("", "rmw_fastrtps_cpp")
_OTHERWISE: Final = (
    *("ROS_DISCOVERY_SERVER", "ROS_STATIC_PEERS", "ROS_SUPER_CLIENT", "FASTDDS_BUILTIN_TRANSPORTS"),
    *("FASTDDS_DEFAULT_PROFILES_FILE", "FASTRTPS_DEFAULT_PROFILES_FILE"),
)
_PROFILES: Final = (
    "DEFAULT_FASTDDS_PROFILES.xml",
    "DEFAULT_FASTRTPS_PROFILES.xml",
)  # of the working directory
_LAST: Final = 232


def domain_on_wire(environment: Mapping[str, str]) -> int | None:
    """Return the domain in which all can be asked on the wire; None where another way is to be taken."""
    number = environment.get("ROS_DOMAIN_ID") or "0"
    usual = (
        environment.get("RMW_IMPLEMENTATION", "") in _MIDDLEWARE
        and _is_alone(environment)
        and environment.get("ROS_SECURITY_ENABLE", "").lower() != "true"
        and not any(environment.get(name) for name in _OTHERWISE)
        and not any(Path(name).exists() for name in _PROFILES)
    )
    if not (usual and number.isascii() and number.isdecimal() and int(number) <= _LAST and tells_ports()):
        return None
    return int(number)


def _is_alone(environment: Mapping[str, str]) -> bool:
    """Tell whether discovery reaches this machine alone; the older of two variables comes first, as in rcl."""
    only = environment.get("ROS_LOCALHOST_ONLY", "")
    return only == "1" or (
        not only and environment.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "").upper() == "LOCALHOST"
    )
