"""The velocity controller on the ROS graph; what it decides is in `bringup.control`."""
