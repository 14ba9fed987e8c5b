"""The filter as a ROS node: parameters, topics, services and the clock around `bringup.filter`."""
