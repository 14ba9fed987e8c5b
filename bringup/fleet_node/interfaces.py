"""The interfaces of the bringup's own that the monitor speaks."""

import bringup.interfaces  # noqa: F401 - makes the package that is imported next

# isort: split

from bringup_interfaces.msg import FleetSummary, RobotSummary
from bringup_interfaces.srv import ClaimGoal, ReleaseGoal

__all__ = ["ClaimGoal", "FleetSummary", "ReleaseGoal", "RobotSummary"]
