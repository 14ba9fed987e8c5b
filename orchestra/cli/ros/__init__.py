"""The ROS command line: one module per command. It reads the words; `orchestra.ros.tools` answers."""
