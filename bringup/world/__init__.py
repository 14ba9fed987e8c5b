"""The simulated world of the bringup: layout, physics, sensors and picture, without ROS but for `messages`."""
