"""The nodes of the bringup, each one `python -m bringup.nodes.NAME --ros-args ...`."""
