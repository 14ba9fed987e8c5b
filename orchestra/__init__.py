"""Launches, checks and supervises systems of ROS 2 nodes."""
