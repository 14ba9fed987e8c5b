"""A component container for nodes written with rclpy: run `python -m orchestra.ros.container EXECUTABLE [ARGUMENTS]`.

It serves `load_node`, `unload_node` and `list_nodes` as the containers of rclcpp_components do, with their names,
answers and numbers (`rclcpp_components/src/component_manager.cpp`). Which of their executables it stands for is its
first word.
"""
