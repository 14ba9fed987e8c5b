"""The bringup's own messages, services and actions: once this is imported, `bringup_interfaces` can be."""

from pathlib import Path

from orchestra.ros.interfaces.definitions import install

install("bringup_interfaces", Path(__file__).parent)
