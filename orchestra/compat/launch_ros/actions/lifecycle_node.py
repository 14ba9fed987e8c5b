"""`LifecycleNode`: starts a ROS node with a managed life cycle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.plain_process import known_flag
from orchestra.compat.launch_ros.actions.node import Node
from orchestra.compat.launch_ros.plain_nodes import USUAL
from orchestra.compat.values import scalar
from orchestra.compat.wrong import WrongRuntime
from orchestra.description.actions.lifecycle_node import LifecycleNode as LifecycleNodeModel

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class LifecycleNode(Node):
    """Start a node whose states are followed. With `autostart` (newer ROS releases) it is configured and activated.

    Raises `RuntimeError` without a name.
    """

    _usual = USUAL.of(LifecycleNodeModel, {"autostart": known_flag}, ("exec", "name"))

    def __init__(
        self, *, name: Sub, namespace: Sub | None, autostart: bool | Sub = False, **kwargs: Any
    ) -> None:
        if name is None:
            told = "a LifecycleNode needs a name, for its services are asked by it"
            raise WrongRuntime(told, path=("name",))
        super().__init__(name=name, namespace=namespace, **kwargs)
        self.__autostart = autostart

    def _keep(self, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> bool:
        return "namespace" in keywords and super()._keep(arguments, keywords)

    @property
    def node_autostart(self) -> bool | Sub:
        """Whether it is configured and activated when it has started."""
        return self.__autostart

    @property
    def is_lifecycle_node(self) -> bool:
        """True."""
        return True

    def _process_model(self, common: Mapping[str, Any]) -> Model:
        span = self._place.span
        autostart = (
            None if self.__autostart is False else scalar(self.__autostart, self._place.at("autostart"))
        )
        fields = self._node_fields() | self._running_fields()
        return LifecycleNodeModel.at(span, autostart=autostart, **fields, **common)
