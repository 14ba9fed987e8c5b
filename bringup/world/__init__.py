"""The simulated world of the bringup: layout, physics, sensors and picture.

Only `inbox`, `messages`, `parameters`, `topics` and `running` know ROS.
"""
