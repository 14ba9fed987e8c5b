"""`LoadComposableNodes`: loads components into a container that runs already."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from orchestra.compat.building import made_of
from orchestra.compat.launch.action import ModelledAction
from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch_ros.actions.composable_node_container import ComposableNodeContainer
from orchestra.compat.launch_ros.descriptions.composable_node import component_models
from orchestra.compat.text import template
from orchestra.compat.wrong import WrongType
from orchestra.description.actions.group import Group
from orchestra.description.actions.load_composable_node import LoadComposableNode
from orchestra.description.text import Opaque, Template

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch_ros.descriptions.composable_node import ComposableNode
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model

__all__ = ["LoadComposableNodes", "get_composable_node_load_request"]


class LoadComposableNodes(ModelledAction):
    """Load components, in order, into the container of an action or of a full name.

    Raises `TypeError` for a target that is neither.
    """

    def __init__(
        self,
        *,
        composable_node_descriptions: Iterable[ComposableNode],
        target_container: Sub | ComposableNodeContainer,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        if not isinstance(target_container, ComposableNodeContainer | str | Substitution | Iterable):
            told_so = f"components are loaded into a container or the name of one, not {target_container!r}"
            raise WrongType(told_so, path=("target_container",))
        self.__composable_node_descriptions = composable_node_descriptions
        self.__target_container = target_container

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        components = component_models(
            self.__composable_node_descriptions, self._place.at("composable_node_descriptions")
        )
        if not components:
            return made_of(Group, self._place, {"children": ()}, common)
        fields = {"target": self.__target(), "composable_node": components}
        return made_of(LoadComposableNode, self._place, fields, common)

    def __target(self) -> Template:
        span = self._place.at("target_container")
        target = self.__target_container
        if isinstance(target, ComposableNodeContainer):
            return Template((Opaque(target, span),), target.describe(), span)
        return template(target, span)


def get_composable_node_load_request(
    composable_node_description: ComposableNode, context: LaunchContext
) -> Any:
    """Return the request for a component in the present scope, None where its condition is false.

    Raises `ImportError` for one with parameters where there is no rclpy.
    """
    from orchestra.compat.launch_ros.load_requests import load_request  # noqa: PLC0415 - few ask for what it imports

    return load_request(composable_node_description, context)
