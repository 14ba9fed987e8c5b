"""Launch files in Python, as they are written by hand for ROS 2."""
