"""Names of actions that are none here, and what they are called here."""

from __future__ import annotations

from typing import Final

# Words of the Python launch files and of ROS 1, and how they are spelled here.
ELSEWHERE: Final = {
    "composable_node_container": "node_container",
    "declare_argument": "arg",
    "declare_launch_argument": "arg",
    "env": "set_env",
    "execute_process": "executable",
    "group_action": "group",
    "include_launch_description": "include",
    "log_info": "log",
    "param": "set_parameter",
    "push_namespace": "push_ros_namespace",
    "remap": "set_remap",
    "rosparam": "set_parameter",
    "set_environment_variable": "set_env",
    "set_launch_configuration": "let",
    "timer_action": "timer",
    "unset_environment_variable": "unset_env",
}
