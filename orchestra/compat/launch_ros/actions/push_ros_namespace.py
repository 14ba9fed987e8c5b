"""`PushROSNamespace`: puts what follows in a namespace."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.building import made_of
from orchestra.compat.launch.plain_action import PlainAction, text_at
from orchestra.compat.text import normalized, template
from orchestra.description.actions.push_ros_namespace import PushRosNamespace as PushRosNamespaceModel

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.place import Arguments
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class PushROSNamespace(PlainAction):
    """Put every node that follows in this scope below a namespace; an absolute one replaces what was pushed."""

    _plain = (1, ("namespace",))

    def __init__(self, namespace: Sub, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__namespace = normalized(namespace)

    @property
    def namespace(self) -> list[Substitution]:
        """The namespace."""
        return self.__namespace

    def _read(self, given: dict[str, Any], call: Arguments) -> tuple[type[Model], dict[str, Any]]:
        return PushRosNamespaceModel, {"namespace": text_at(given["namespace"], call, "namespace")}

    def _made(self, common: Mapping[str, Any]) -> Model:
        namespace = template(self.namespace, self._place.at("namespace"))
        return made_of(PushRosNamespaceModel, self._place, {"namespace": namespace}, common)


PushRosNamespace = PushROSNamespace
