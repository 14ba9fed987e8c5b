"""The interfaces of the bringup's own that the simulation speaks."""

import bringup.interfaces  # noqa: F401 - makes the package that is imported next

# isort: split

from bringup_interfaces.msg import Contact, Contacts
from bringup_interfaces.srv import SetSpeed, Step, Teleport

__all__ = ["Contact", "Contacts", "SetSpeed", "Step", "Teleport"]
