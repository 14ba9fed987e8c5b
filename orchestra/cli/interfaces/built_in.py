"""The definitions of the types that Orchestra brings because no wheel has their packages: names, types and order."""

from __future__ import annotations

from typing import Final

DEFINITIONS: Final = {
    "tf2_msgs/msg/TFMessage": "geometry_msgs/TransformStamped[] transforms\n",
    "composition_interfaces/srv/LoadNode": """\
string package_name
string plugin_name
string node_name
string node_namespace
uint8 log_level
string[] remap_rules
rcl_interfaces/Parameter[] parameters
rcl_interfaces/Parameter[] extra_arguments
---
bool success
string error_message
string full_node_name
uint64 unique_id
""",
}
