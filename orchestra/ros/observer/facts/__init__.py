"""What can be awaited in the ROS graph: one file per kind of fact, in the table of `orchestra.ros.observer.kinds`."""
