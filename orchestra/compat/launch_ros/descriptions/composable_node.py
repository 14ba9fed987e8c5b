"""`ComposableNode`: a component."""

from __future__ import annotations

from collections.abc import Iterable
from importlib import import_module
from typing import TYPE_CHECKING, Any, Self

from orchestra.compat.building import condition_fields
from orchestra.compat.explanation import told
from orchestra.compat.launch_ros.models import params, remaps
from orchestra.compat.launch_ros.utilities.normalize_parameters import normalize_parameters
from orchestra.compat.launch_ros.utilities.normalize_remap_rule import normalize_remap_rules
from orchestra.compat.place import here
from orchestra.compat.text import normalized, template
from orchestra.compat.values import optional
from orchestra.description.components import ComposableNode as ComposableNodeModel

if TYPE_CHECKING:
    from orchestra.compat.launch.condition import Condition
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub


class ComposableNode:
    """A class of a package, loaded into a container as a node. Raises `TypeError` as `Node` does."""

    def __init__(  # noqa: PLR0913 - upstream's signature, and a key of ours
        self,
        *,
        package: Sub,
        plugin: Sub,
        name: Sub | None = None,
        namespace: Sub | None = None,
        parameters: Any = None,
        remappings: Any = None,
        extra_arguments: Any = None,
        condition: Condition | None = None,
        params_schema: Sub | None = None,
    ) -> None:
        self._place = here(self)
        self.__params_schema = None if params_schema is None else normalized(params_schema)
        self.__package = normalized(package)
        self.__node_plugin = normalized(plugin)
        self.__node_name = None if name is None else normalized(name)
        self.__node_namespace = None if namespace is None else normalized(namespace)
        self.__parameters = None if parameters is None else normalize_parameters(parameters)
        self.__remappings = normalize_remap_rules(remappings) if remappings else None
        self.__extra_arguments = normalize_parameters(extra_arguments) if extra_arguments else None
        self.__condition = condition

    @classmethod
    def parse(cls, parser: Any, entity: Any) -> tuple[type[Self], dict[str, Any]]:
        """Return the class and the keywords with which an entity of a launch file in XML or YAML constructs it."""
        read = import_module("orchestra.compat.launch.frontend.reading.nodes")  # which few launch files need
        return cls, read.composable_node(entity, parser)

    @property
    def package(self) -> list[Substitution]:
        """The package."""
        return self.__package

    @property
    def node_plugin(self) -> list[Substitution]:
        """The class, as the package registers it."""
        return self.__node_plugin

    @property
    def node_name(self) -> list[Substitution] | None:
        """The name of the node."""
        return self.__node_name

    @property
    def node_namespace(self) -> list[Substitution] | None:
        """The namespace."""
        return self.__node_namespace

    @property
    def parameters(self) -> Any:
        """The normalised parameters, None without any."""
        return self.__parameters

    @property
    def remappings(self) -> Any:
        """The normalised remapping rules, None without any."""
        return self.__remappings

    @property
    def extra_arguments(self) -> Any:
        """What else the container is told, normalised as parameters; None for nothing."""
        return self.__extra_arguments

    def condition(self) -> Condition | None:
        """Return when it is loaded, None: always."""
        return self.__condition

    def _to_model(self) -> ComposableNodeModel:
        span = self._place.span
        condition = self.condition()
        return ComposableNodeModel.at(
            span,
            origin=self,
            pkg=template(self.package, span),
            plugin=template(self.node_plugin, span),
            name=optional(self.node_name, span),
            namespace=optional(self.node_namespace, span),
            param=params(self.parameters or (), span),
            remap=remaps(self.remappings or (), span),
            extra_arg=params(self.extra_arguments or (), span),
            params_schema=optional(self.__params_schema, span),
            **self._more(),
            **({} if condition is None else condition_fields(condition, span)),
        )

    def _more(self) -> dict[str, Any]:
        """Return the fields that a kind of component has beside these."""
        return {}


def component_models(components: Any) -> tuple[ComposableNodeModel, ...]:
    """Return the models of components. Raises `TypeError` for anything else than a list of them."""
    if isinstance(components, ComposableNode | str) or not isinstance(components, Iterable):
        raise TypeError(f"composable_node_descriptions is a list, this is {told(components)}")
    return tuple(_component_model(item) for item in components)


def _component_model(item: Any) -> ComposableNodeModel:
    if not isinstance(item, ComposableNode):
        raise TypeError(f"composable_node_descriptions are of the class ComposableNode, this is {told(item)}")
    return item._to_model()
