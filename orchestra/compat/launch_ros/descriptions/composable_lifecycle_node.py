"""`ComposableLifecycleNode`: a component with a managed life cycle (newer ROS releases)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch_ros.descriptions.composable_node import ComposableNode
from orchestra.compat.values import scalar

if TYPE_CHECKING:
    from orchestra.compat.text import Sub


class ComposableLifecycleNode(ComposableNode):
    """A component; with `autostart` it is configured and activated when it has been loaded."""

    def __init__(self, *, autostart: bool | Sub = False, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__autostart = autostart

    @property
    def node_autostart(self) -> bool | Sub:
        """Whether it is configured and activated."""
        return self.__autostart

    def _more(self) -> dict[str, Any]:
        return (
            {}
            if self.__autostart is False
            else {"autostart": scalar(self.__autostart, self._place.at("autostart"))}
        )
