"""`ComposableNodeContainer`: starts a process that components are loaded into."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch_ros.actions.node import Node
from orchestra.compat.launch_ros.descriptions.composable_node import component_models
from orchestra.compat.wrong import WrongType
from orchestra.description.actions.node import INSTEAD
from orchestra.description.actions.node_container import NodeContainer

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from orchestra.compat.launch_ros.descriptions.composable_node import ComposableNode
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class ComposableNodeContainer(Node):
    """Start a container, and load components into it as soon as it takes orders. Raises `TypeError` without a name."""

    def __init__(
        self,
        *,
        name: Sub,
        namespace: Sub | None,
        composable_node_descriptions: Iterable[ComposableNode] | None = None,
        **kwargs: Any,
    ) -> None:
        if name is None:
            told = "a ComposableNodeContainer needs a name, for components are loaded by it"
            raise WrongType(told, path=("name",))
        for key in INSTEAD:
            if kwargs.get(key) is not None:
                raise WrongType(
                    f"a ComposableNodeContainer is no program in Python: it has no '{key}'", path=(key,)
                )
        super().__init__(name=name, namespace=namespace, **kwargs)
        self.__composable_node_descriptions = composable_node_descriptions

    def _process_model(self, common: Mapping[str, Any]) -> Model:
        span = self._place.span
        components = component_models(
            self.__composable_node_descriptions or (), self._place.at("composable_node_descriptions")
        )
        fields = self._node_fields() | self._running_fields()
        return NodeContainer.at(span, composable_node=components, **fields, **common)
