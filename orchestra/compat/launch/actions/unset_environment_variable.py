"""`UnsetEnvironmentVariable`: removes an environment variable."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import ModelledAction
from orchestra.compat.text import normalized, template
from orchestra.description.actions.unset_env import UnsetEnv

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class UnsetEnvironmentVariable(ModelledAction):
    """Remove an environment variable, where it is set, for what follows in this scope."""

    def __init__(self, name: Sub, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name = normalized(name)

    @property
    def name(self) -> list[Substitution]:
        """The name."""
        return self.__name

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        span = self._place.span
        return UnsetEnv.at(span, name=template(self.name, span), **common)
