"""What packages derive from that add to the command line of every node: entry points `launch_ros.node_action`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch_ros.utilities.plugin_support import satisfies_version

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext


class NodeActionExtension:
    """Is made for each node. `NAME` is that of the entry point. Raises `PluginException` for another version."""

    NAME: str | None = None
    EXTENSION_POINT_VERSION = "0.1"

    def __init__(self) -> None:
        satisfies_version(self.EXTENSION_POINT_VERSION, "^0.1")

    def prepare_for_execute(
        self,
        context: LaunchContext,  # noqa: ARG002 - for subclasses
        ros_specific_arguments: dict[str, Any],
        node_action: Any,  # noqa: ARG002 - for subclasses
    ) -> tuple[list[Any], dict[str, Any]]:
        """Return words to add to the command, and the arguments, perhaps others: `name` and `ns` are rules."""
        return [], ros_specific_arguments
