"""The fleet monitor on the ROS graph; what it knows and decides is in `bringup.fleet`."""
