"""The interfaces of the bringup's own that the controller speaks."""

import bringup.interfaces  # noqa: F401 - makes the package that is imported next

# isort: split

from bringup_interfaces.action import GoToGoal
from bringup_interfaces.srv import ClaimGoal, ReleaseGoal

__all__ = ["ClaimGoal", "GoToGoal", "ReleaseGoal"]
