"""Extended Kalman filter for a mobile robot's pose and motion, without ROS.

Parameters, state, equations and timing follow robot_localization's `ekf_node` (ROS 2, 3.6.0); places where
this filter differs on purpose say so where they stand.
"""
