"""The command arbiter on the ROS graph; what it decides is in `bringup.arbiter`."""
