"""`ComposableNode`: a component."""

from __future__ import annotations

from collections.abc import Iterable
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final, Self

from orchestra.compat.building import condition_fields
from orchestra.compat.explanation import told
from orchestra.compat.launch_ros.models import params, remaps
from orchestra.compat.launch_ros.plain_components import USUAL, PlainComponent
from orchestra.compat.launch_ros.utilities.normalize_parameters import normalize_parameters
from orchestra.compat.launch_ros.utilities.normalize_remap_rule import normalize_remap_rules
from orchestra.compat.place import IN_CONSTRUCTOR, here, within
from orchestra.compat.text import normalized, template
from orchestra.compat.values import optional
from orchestra.compat.wrong import WrongType
from orchestra.description.components import ComposableNode as ComposableNodeModel

if TYPE_CHECKING:
    from orchestra.compat.launch.condition import Condition
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub
    from orchestra.location import Span

_COMPONENTS: Final = "composable_node_descriptions"


class ComposableNode(PlainComponent):
    """A class of a package, loaded into a container as a node. Raises `TypeError` as `Node` does."""

    _usual = USUAL

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
        self._place = here(self, IN_CONSTRUCTOR)
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
        plain = self._plain_model()
        if plain is not None:
            return plain
        at, condition = self._place.at, self.condition()
        model = ComposableNodeModel.at(
            self._place.span,
            origin=self,
            pkg=template(self.package, at("package")),
            plugin=template(self.node_plugin, at("plugin")),
            name=optional(self.node_name, at("name")),
            namespace=optional(self.node_namespace, at("namespace")),
            param=params(self.parameters or (), at("parameters")),
            remap=remaps(self.remappings or (), at("remappings")),
            extra_arg=params(self.extra_arguments or (), at("extra_arguments")),
            params_schema=optional(self.__params_schema, at("params_schema")),
            **self._more(),
            **({} if condition is None else condition_fields(condition, at("condition"))),
        )
        if self._refused:
            model.mark_faulty()
        return model

    def _more(self) -> dict[str, Any]:
        """Return the fields that a kind of component has beside these."""
        return {}


def component_models(components: Any, span: Span) -> tuple[ComposableNodeModel, ...]:
    """Return the models of components. Raises `TypeError` for anything else than a list of them."""
    if isinstance(components, ComposableNode | str) or not isinstance(components, Iterable):
        told_so = f"composable_node_descriptions is a list, this is {told(components)}"
        raise WrongType(told_so, components, at=span)
    known = list(components)
    for index, item in enumerate(known):
        if not isinstance(item, ComposableNode):
            told_so = f"{_COMPONENTS} are of the class ComposableNode, this is {told(item)}"
            raise WrongType(told_so, item, at=within(span, index))
    return tuple(item._to_model() for item in known)
