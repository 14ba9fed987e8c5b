"""`SetEnvironmentVariable`: sets an environment variable."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import ModelledAction
from orchestra.compat.text import normalized, template
from orchestra.description.actions.set_env import SetEnv

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class SetEnvironmentVariable(ModelledAction):
    """Set an environment variable for what follows in this scope."""

    def __init__(self, name: Sub, value: Sub, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name = normalized(name)
        self.__value = normalized(value)

    @property
    def name(self) -> list[Substitution]:
        """The name."""
        return self.__name

    @property
    def value(self) -> list[Substitution]:
        """The value."""
        return self.__value

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        span = self._place.span
        return SetEnv.at(span, name=template(self.name, span), value=template(self.value, span), **common)
