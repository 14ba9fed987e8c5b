"""`PushROSNamespace`: puts what follows in a namespace."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.building import made_of
from orchestra.compat.launch.action import ModelledAction
from orchestra.compat.text import normalized, template
from orchestra.description.actions.push_ros_namespace import PushRosNamespace as PushRosNamespaceModel

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class PushROSNamespace(ModelledAction):
    """Put every node that follows in this scope below a namespace; an absolute one replaces what was pushed."""

    def __init__(self, namespace: Sub, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__namespace = normalized(namespace)

    @property
    def namespace(self) -> list[Substitution]:
        """The namespace."""
        return self.__namespace

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        namespace = template(self.namespace, self._place.at("namespace"))
        return made_of(PushRosNamespaceModel, self._place, {"namespace": namespace}, common)


PushRosNamespace = PushROSNamespace
